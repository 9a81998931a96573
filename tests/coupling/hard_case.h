#pragma once

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "coupling/read_table.h"
#include "coupling/run.h"
#include "temporary_folder.h"

/// One hard case: a scene that a run could well fail on, and what must hold of its result. A test
/// case is its settings and its bounds; what it measured is said in one line.
namespace hard {

using Settings = std::vector<std::string>;

/// The paper's rod; a case sets its path, and what is hard about it.
inline const std::string scene = R"([rod]
length = "350 mm"
diameter = "8.3 mm"
[material]
youngs_modulus = "1.25 MPa"
[solid3d]
section_elements = 12
)";
constexpr double diameter = 8.3e-3;  ///< of that rod [m]

inline Settings operator+(Settings settings, const Settings& more) {
  settings.insert(settings.end(), more.begin(), more.end());
  return settings;
}

/// The same rod, but for its size and stiffness.
inline Settings scaled(double D, double E) {
  return {fmt::format("rod.diameter={:.17g}", D), fmt::format("rod.length={:.17g}", 42 * D),
          fmt::format("material.youngs_modulus={:.17g}", E)};
}

inline const std::vector<std::pair<double, double>> extremes = {
    {1e-6, 1}, {1e-6, 1e12}, {1, 1}, {1, 1e12}};  ///< D [m] and E [Pa]

/// What one fidelity of a run has left: its part of summary.json and its force.csv.
struct Result {
  nlohmann::json summary;
  bight::coupling::Table force;
  std::filesystem::path centerlines;  ///< folder with those that were recorded

  bool finished() const { return summary.value("status", "") == "finished"; }
  /// Normalised force at a recorded state.
  double tbar(size_t state) const { return summary["states"][state]["force_normalised"]; }
  /// Stored energy at a recorded state [J].
  double energy(size_t state) const {
    double sum = 0;
    for (const auto& [effect, energy] : summary["states"][state]["energy_J"].items())
      sum += energy.get<double>();
    return sum;
  }
  size_t states() const { return summary["states"].size(); }
  double of(size_t row, const char* column) const {
    return force.rows[row][static_cast<size_t>(force.column(column))];
  }
  /// Seconds that the path took.
  double seconds() const { return summary.value("wall_s", 0.0); }
};

inline Result read_result(const std::filesystem::path& folder, const std::string& fidelity) {
  Result result;
  const auto summary = nlohmann::json::parse(text_of(folder / "summary.json"));
  if (summary.contains(fidelity)) result.summary = summary[fidelity];
  INFO(summary["verdict"]);
  if (result.summary.is_null()) FAIL("no " << fidelity << ": " << summary["verdict"]);
  result.force = bight::coupling::read_table(folder / fidelity / "force.csv");
  result.centerlines = folder / fidelity / "centerline";
  return result;
}

/// The scene with these settings, run into `folder` as `bight FIDELITY` would.
inline Result run(const TemporaryFolder& folder, const std::string& fidelity,
                  const Settings& settings, int threads = 1) {
  static int runs = 0;
  const auto out = folder.path() / fmt::format("run_{}", ++runs);
  const auto file = folder.write("scene.toml", scene);
  const auto read = bight::coupling::read_scene(file, settings, {fidelity});
  const int before = omp_get_max_threads();
  bight::coupling::run(read, {.folder = out, .threads = threads, .quiet = true});
  omp_set_num_threads(before);
  return read_result(out, fidelity);
}

inline Result run(const std::string& fidelity, const Settings& settings, int threads = 1) {
  const TemporaryFolder folder;
  return run(folder, fidelity, settings, threads);
}

/// Work of the ends that is neither stored nor dissipated at the end of the path, over all work
/// done either way; the work by the trapezoidal rule.
inline double imbalance(const Result& result, double of_diameter = diameter) {
  double work = 0, all = 0;
  const size_t last = result.force.rows.size() - 1;
  for (size_t i = 1; i <= last; ++i) {
    const double step = result.of(i - 1, "ebar") - result.of(i, "ebar");
    const double done =
        0.5 * (result.of(i, "force_n") + result.of(i - 1, "force_n")) * step * of_diameter;
    work += done, all += std::abs(done);
  }
  const double kept = result.of(last, "energy_j") - result.of(0, "energy_j") +
                      result.of(last, "dissipated_j") - result.of(0, "dissipated_j");
  return (work - kept) / all;
}

/// Bounds of one case.
struct Holds {
  double penetration = 0;  ///< largest overlap [D]; 0: 0.002
  double jacobian = 0.3;   ///< smallest volume ratio of a cell
  double balance = 0.01;   ///< largest part of the work that may be unexplained; 0: not asked for
  double mismatch = 1e-4;  ///< largest difference of the ends' tensions, over T
  int determinant = 3;     ///< of the knot, at every recorded state
};

inline void say(const std::string& what) {
  fmt::print("measured  {}: {}\n", Catch::getResultCapture().getCurrentTestName(), what);
}

/// Completed, the same knot at every recorded state, no inversion, overlap in bound, ends in
/// balance, energy balance.
inline void must_hold(const Result& result, const Holds& holds = {}) {
  INFO(result.summary.value("reason", ""));
  REQUIRE_FALSE(result.force.rows.empty());
  const bool solid = result.summary.contains("cells");
  const double penetration = result.summary.value("worst_penetration", 0.0);
  const double jacobian = result.summary.value("smallest_jacobian", 1.0);
  const double mismatch = result.summary.value("worst_reaction_mismatch", 0.0);
  const double left = holds.balance > 0 ? imbalance(result) : 0;
  const size_t last = result.force.rows.size() - 1;
  say(fmt::format(
      "{} to ebar {:.4g}, Tbar {:.5g}, {} steps, {} cutbacks, {} iterations, penetration {:.2g} D, "
      "{}mismatch of the ends {:.1g}{}, {:.2g} s",
      solid ? "solid" : "rod", result.of(last, "ebar"), result.of(last, "force_normalised"),
      result.summary["steps"].get<int>(), result.summary["cutbacks"].get<int>(),
      result.summary["newton_iterations"].get<int>(), penetration,
      solid ? fmt::format("smallest J {:.2g}, ", jacobian) : "", mismatch,
      holds.balance > 0 ? fmt::format(", energy unexplained {:.2g} %", 100 * left) : "",
      result.seconds()));
  CHECK(result.finished());
  for (const auto& state : result.summary["states"])
    CHECK(state["determinant"] == holds.determinant);
  CHECK(penetration <= (holds.penetration > 0 ? holds.penetration : 0.002));
  CHECK(jacobian > holds.jacobian);
  CHECK(mismatch < holds.mismatch);
  if (holds.balance > 0) CHECK(std::abs(left) < holds.balance);
}

/// The same force and stored energy at all recorded states as a gentler run.
inline void same_as(const Result& gentler, const Result& result, double force, double energy) {
  REQUIRE(result.states() == gentler.states());
  double of_force = 0, of_energy = 0;
  for (size_t i = 0; i < result.states(); ++i) {
    of_force = std::max(of_force, std::abs(result.tbar(i) / gentler.tbar(i) - 1));
    of_energy = std::max(of_energy, std::abs(result.energy(i) / gentler.energy(i) - 1));
  }
  say(
      fmt::format("differs from a gentler run by {:.2g} in force ({:.2g} allowed), {:.2g} in "
                  "energy ({:.2g})",
                  of_force, force, of_energy, energy));
  CHECK(of_force <= force);
  CHECK(of_energy <= energy);
}

/// Tbar is the same to 1e-6 whatever D and E.
inline void same_tbar(const Result& a, const Result& b) {
  REQUIRE(a.states() == b.states());
  double worst = 0;
  for (size_t i = 0; i < a.states(); ++i)
    worst = std::max(worst, std::abs(a.tbar(i) / b.tbar(i) - 1));
  say(fmt::format("Tbar differs by {:.1g}", worst));
  CHECK(worst <= 1e-6);
}

}  // namespace hard
