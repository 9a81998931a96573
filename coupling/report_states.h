#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

namespace bight::coupling {

/// The recorded states of a results folder, evenly thinned to at most `most` and until they take
/// at most `bytes`: {"recorded": how many there are, "quads": of the solid's surface, "list":
/// [{"name", "ebar", "rod": {column: packed}, "contacts": {column: packed}, "solid": {column:
/// packed}, "surface": {x, y, z and fields: packed}}]}. Lengths are in `diameter` [m], fields as in
/// the files.
nlohmann::ordered_json report_states(const std::filesystem::path& folder, double diameter,
                                     size_t most, size_t bytes);

}  // namespace bight::coupling
