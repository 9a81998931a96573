#include "coupling/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "coupling/units.h"

namespace bight::coupling {
namespace {

constexpr int bar_width = 24;

std::string clock(double seconds) {
  const long s = std::lround(seconds);
  return s < 3600 ? fmt::format("{}:{:02}", s / 60, s % 60)
                  : fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60);
}

}  // namespace

std::string status_line(const std::string& fidelity, const StepRow& row) {
  std::string line = fmt::format(
      "{:<5} ebar {:8.3f}  step {:+7.3f}  Tbar {:.6g}  iterations {}  contacts {}  residual {:.1e} "
      " "
      "{:.2f} s",
      fidelity, row.ebar, row.increment, normalised_force(row.tension), row.newton_iterations,
      row.contact_pairs, row.residual, row.wall_s);
  if (row.cutbacks > 0) line += fmt::format("  cutbacks {} ({})", row.cutbacks, row.cut_reason);
  if (row.snapped > 0) line += "  SNAP to another branch of equilibria";
  return line;
}

Progress::Progress(const std::filesystem::path& log, bool quiet)
    : log_(log, "bight run log: one line per accepted step"),
      quiet_(quiet),
      terminal_(isatty(STDOUT_FILENO) != 0) {}

void Progress::begin(const std::string& fidelity, const Path& path) {
  fidelity_ = fidelity;
  length_ = covered_ = 0;
  for (size_t i = 1; i < path.waypoints.size(); ++i)
    length_ += std::abs(path.waypoints[i] - path.waypoints[i - 1]);
  if (terminal_ && !quiet_) {
    fmt::print("\r\033[K{:<5} finding the first equilibrium", fidelity);
    std::fflush(stdout);
  }
}

void Progress::step(const StepRow& row) {
  const std::string line = status_line(fidelity_, row);
  log_.line(line);
  if (quiet_) return;
  if (!terminal_) {
    fmt::print("{}\n", line);
    std::fflush(stdout);
    return;
  }
  if (length_ == 0) {  // the way to a force is not known
    fmt::print("\r\033[K{:<5} ebar {:.2f}  Tbar {:.4g}", fidelity_, row.ebar,
               normalised_force(row.tension));
    std::fflush(stdout);
    return;
  }
  covered_ += std::abs(row.increment);
  const double done = std::min(1.0, covered_ / length_);
  const int full = static_cast<int>(done * bar_width);
  const double left = done > 0 ? row.wall_s * (1 - done) / done : 0;
  fmt::print("\r\033[K{:<5} [{:#<{}}{:<{}}] ebar {:.2f}  Tbar {:.4g}  {} left", fidelity_, "", full,
             "", bar_width - full, row.ebar, normalised_force(row.tension), clock(left));
  std::fflush(stdout);
}

void Progress::end() {
  if (terminal_ && !quiet_) fmt::print("\r\033[K");
}

void Progress::say(const std::string& text) {
  log_.line(text);
  if (quiet_) return;
  fmt::print("{}\n", text);
  std::fflush(stdout);
}

}  // namespace bight::coupling
