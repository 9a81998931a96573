#pragma once

#include <string>

/// The shortest scene that is complete; a rod of 42 diameters.
inline const std::string small_scene = R"([rod]
length = "350 mm"
diameter = "8.3 mm"
[material]
youngs_modulus = "1.25 MPa"
[path]
ebar = [30, 20]
)";

/// The same with one piece of text replaced.
inline std::string small_scene_with(const std::string& old_text, const std::string& new_text) {
  std::string text = small_scene;
  return text.replace(text.find(old_text), old_text.size(), new_text);
}
