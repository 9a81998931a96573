#pragma once

#include <functional>
#include <string>
#include <vector>

namespace bight::coupling {

/// A program and its words.
using Words = std::vector<std::string>;

/// Runs programs, `at_once` of them side by side, each in a process of its own. `ended` hears of
/// each with its exit status (128 + the signal that killed it). Once interrupted it asks those that
/// run to stop, waits for them and returns false.
bool run_side_by_side(const std::vector<Words>& programs, int at_once,
                      const std::function<void(size_t index, int status)>& ended);

/// The words as a line for a shell.
std::string shell_line(const Words& words);

}  // namespace bight::coupling
