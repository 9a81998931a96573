#pragma once

#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <string>

#include "temporary_folder.h"

/// What a call of the built program came to.
struct Outcome {
  int status;
  std::string said, complained;
};

/// `bight WORDS` in that folder.
inline Outcome call(const TemporaryFolder& folder, const std::string& words) {
  const std::string command =
      "cd '" + folder.path().string() + "' && " BIGHT_PROGRAM " " + words + " > said 2> complained";
  const int status = std::system(command.c_str());
  return {WEXITSTATUS(status), text_of(folder / "said"), text_of(folder / "complained")};
}

inline size_t lines(const std::string& text) { return std::ranges::count(text, '\n'); }
