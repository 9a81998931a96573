#pragma once

#include <chrono>
#include <string>
#include <vector>

namespace bight::coupling {

/// Wall seconds, processor seconds of all threads and peak memory by phase of a run. One phase is
/// current at a time.
class Phases {
 public:
  struct Phase {
    std::string name;
    double wall_s = 0, cpu_s = 0;
    double peak_MB = 0;
  };

  /// Ends the current phase and begins (or goes on with) another; returns the name of the one
  /// ended.
  std::string enter(const std::string& name);
  const std::vector<Phase>& list() const { return phases_; }
  double seconds(const std::string& name) const;

 private:
  std::vector<Phase> phases_;
  size_t current_ = 0;
  std::chrono::steady_clock::time_point since_;
  double cpu_since_ = 0;
};

}  // namespace bight::coupling
