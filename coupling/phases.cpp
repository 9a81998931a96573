#include "coupling/phases.h"

#include <time.h>

#include <algorithm>
#include <fstream>

namespace bight::coupling {
namespace {

// Linux: VmHWM is the largest resident size since the start or since 5 was written to clear_refs.
double peak_memory_MB() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmHWM:")) return std::stod(line.substr(6)) / 1024;  // kB
  return 0;
}

// Of all threads.
double cpu_seconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

void restart_peak_memory() { std::ofstream("/proc/self/clear_refs") << "5"; }

}  // namespace

std::string Phases::enter(const std::string& name) {
  const auto now = std::chrono::steady_clock::now();
  std::string ended;
  if (!phases_.empty()) {
    Phase& phase = phases_[current_];
    phase.wall_s += std::chrono::duration<double>(now - since_).count();
    phase.cpu_s += cpu_seconds() - cpu_since_;
    phase.peak_MB = std::max(phase.peak_MB, peak_memory_MB());
    ended = phase.name;
  }
  const auto found = std::ranges::find(phases_, name, &Phase::name);
  current_ = static_cast<size_t>(found - phases_.begin());
  if (found == phases_.end()) phases_.push_back({name});
  since_ = now;
  cpu_since_ = cpu_seconds();
  restart_peak_memory();
  return ended;
}

double Phases::seconds(const std::string& name) const {
  const auto found = std::ranges::find(phases_, name, &Phase::name);
  return found == phases_.end() ? 0 : found->wall_s;
}

}  // namespace bight::coupling
