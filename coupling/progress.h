#pragma once

#include <filesystem>
#include <string>

#include "coupling/files.h"
#include "mechanics/path.h"

namespace bight::coupling {

/// "rod    ebar  20.000  step -0.500 ...": one accepted step, for run.log and for the eye.
std::string status_line(const std::string& fidelity, const StepRow& row);

/// Tells the user how far a run is: a bar on a terminal, else a line per step; all lines in
/// run.log.
class Progress {
 public:
  Progress(const std::filesystem::path& log, bool quiet);
  void begin(const std::string& fidelity, const Path& path);
  void step(const StepRow& row);
  void end();                         ///< the bar is done with
  void say(const std::string& text);  ///< a line for both, also when quiet only for the log

 private:
  LineFile log_;
  bool quiet_, terminal_;
  std::string fidelity_;
  double length_ = 0;   ///< of the whole path in ebar
  double covered_ = 0;  ///< of it so far
};

}  // namespace bight::coupling
