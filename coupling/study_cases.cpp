#include "coupling/study_cases.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "coupling/compare_centerlines.h"
#include "coupling/convergence.h"

namespace bight::coupling {
namespace {

constexpr double margin = 1.25;  // of an error estimated from three runs (Roache 1994)

bool concerns(const Dimension& dimension, const std::string& fidelity) {
  return fidelity != "rod" || !dimension.key->path.starts_with("solid3d.");
}

bool of_the_problem(const Dimension& dimension) {
  return dimension.key->fineness == Fineness::physical;
}

/// What all steps of the analysis look at.
struct Analysis {
  const std::vector<Dimension>& grid;
  const std::vector<GridPoint>& points;
  std::vector<StudyRow>& rows;

  size_t at(size_t row, size_t dimension) const { return points[rows[row].point].at[dimension]; }
  double size(size_t row, size_t d) const { return grid[d].size(at(row, d)); }
};

// How fine a run is: 1 for every key at its finest, 0 at its coarsest; of choices the first counts.
double fineness(const Analysis& a, size_t row) {
  double result = 0;
  for (size_t d = 0; d < a.grid.size(); ++d) {
    const size_t values = a.grid[d].values.size();
    if (a.grid[d].resolution()) {
      size_t coarser = 0;
      for (size_t v = 0; v < values; ++v) coarser += a.grid[d].size(v) > a.size(row, d);
      if (values > 1) result += static_cast<double>(coarser) / static_cast<double>(values - 1);
    } else if (!of_the_problem(a.grid[d])) {
      result -= 1e-3 * static_cast<double>(a.at(row, d));
    }
  }
  return result;
}

std::optional<size_t> finest(const Analysis& a, const StudyCase& of) {
  std::optional<size_t> best;
  for (const size_t row : of.rows)
    if (a.rows[row].finished() && (!best || fineness(a, row) > fineness(a, *best))) best = row;
  return best;
}

// Finished runs that differ from the reference in dimension d at most, the finest first.
std::vector<size_t> line_through_reference(const Analysis& a, const StudyCase& of, size_t d) {
  std::vector<size_t> line;
  for (const size_t row : of.rows) {
    bool same = a.rows[row].finished();
    for (size_t other = 0; other < a.grid.size(); ++other)
      same = same && (other == d || !concerns(a.grid[other], of.fidelity) ||
                      a.at(row, other) == a.at(*of.reference, other));
    if (same) line.push_back(row);
  }
  std::ranges::stable_sort(line, {}, [&](size_t row) { return a.size(row, d); });
  return line;
}

// Differences relative to the middle run; nothing without a state in common.
KeyOrder order_of(const Analysis& a, size_t d, size_t r1, size_t r2, size_t r3) {
  KeyOrder order{a.grid[d].key, {}, {}, {}, {}};
  for (const size_t row : {r1, r2, r3}) order.values.push_back(a.grid[d].values[a.at(row, d)]);
  RecordedStates common;
  for (const auto& [when, state] : a.rows[r2].states)
    if (a.rows[r1].states.contains(when) && a.rows[r3].states.contains(when)) common[when] = state;
  const auto fine = error_against(a.rows[r1].states, common);
  const auto coarse = error_against(a.rows[r3].states, common);
  if (!fine || !coarse) return order;
  const std::array<double, 3> h = {a.size(r1, d), a.size(r2, d), a.size(r3, d)};
  order.force_largest = observed_order(h, fine->force_largest, coarse->force_largest);
  order.force_mean = observed_order(h, fine->force_mean, coarse->force_mean);
  order.energy = observed_order(h, fine->energy_mean, coarse->energy_mean);
  return order;
}

// What Richardson's extrapolation makes of two runs; the order of energy may be unknown.
RecordedStates extrapolated(const Analysis& a, size_t d, size_t fine, size_t coarse,
                            const KeyOrder& order) {
  const double h1 = a.size(fine, d), h2 = a.size(coarse, d);
  RecordedStates states;
  for (const auto& [when, f1] : a.rows[fine].states) {
    const auto f2 = a.rows[coarse].states.find(when);
    if (f2 == a.rows[coarse].states.end()) continue;
    RecordedState& state = states[when] = f1;
    state.force += (f1.force - f2->second.force) * error_left(h1, h2, *order.force_largest);
    if (order.energy)
      state.energy += (f1.energy - f2->second.energy) * error_left(h1, h2, *order.energy);
  }
  return states;
}

double apart(const RecordedStates& a, const RecordedStates& b) {
  const auto error = error_against(a, b);
  return error ? error->force_largest : 0;
}

// For each run of a line the next two whose sizes are about twice as large each time; orders from
// neighbours that are closer are mostly noise. Where there are none, the neighbours.
std::vector<std::array<size_t, 3>> triples(const Analysis& a, size_t d,
                                           const std::vector<size_t>& line) {
  constexpr double enough = 1.8;
  const auto next = [&](size_t i) {
    size_t k = i + 1;
    while (k < line.size() && a.size(line[k], d) < enough * a.size(line[i], d)) ++k;
    return k;
  };
  std::vector<std::array<size_t, 3>> result;
  for (size_t i = 0; i + 2 < line.size(); ++i) {
    const size_t j = next(i), k = j < line.size() ? next(j) : j;
    if (k < line.size())
      result.push_back({line[i], line[j], line[k]});
    else if (i == 0)
      result.push_back({line[0], line[1], line[2]});
  }
  return result;
}

// Orders, what they leave uncertain in the reference, and the states it stands for.
RecordedStates judge_reference(const Analysis& a, const std::string& extrapolate, StudyCase& of) {
  RecordedStates reference = a.rows[*of.reference].states;
  for (size_t d = 0; d < a.grid.size(); ++d) {
    if (!a.grid[d].resolution() || !concerns(a.grid[d], of.fidelity)) continue;
    const std::vector<size_t> line = line_through_reference(a, of, d);
    if (line.size() < 2 || line[0] != *of.reference) continue;
    const RecordedStates& fine = a.rows[line[0]].states;
    KeyUncertainty uncertainty{a.grid[d].key, apart(a.rows[line[1]].states, fine), false, false};
    const auto threes = triples(a, d, line);
    const size_t first = of.orders.size();
    for (const auto& [r1, r2, r3] : threes) of.orders.push_back(order_of(a, d, r1, r2, r3));
    if (!threes.empty() && of.orders[first].force_largest) {
      const KeyOrder& order = of.orders[first];
      const auto [r1, r2, r3] = threes[0];
      uncertainty.order_known = true;
      uncertainty.force = margin * apart(a.rows[r2].states, fine) *
                          error_left(a.size(r1, d), a.size(r2, d), *order.force_largest);
      if (a.grid[d].key->path == extrapolate) {
        // A quarter of the correction, or what the next coarser pair makes another of it.
        reference = extrapolated(a, d, r1, r2, order);
        uncertainty.extrapolated = of.extrapolated = true;
        uncertainty.force = std::max((margin - 1) * apart(fine, reference),
                                     apart(extrapolated(a, d, r2, r3, order), reference));
      }
    }
    of.uncertainties.push_back(uncertainty);
  }
  return reference;
}

void measure(const Analysis& a, StudyCase& of) {
  const StudyRow& finest_row = a.rows[*of.reference];
  std::vector<Tradeoff> tradeoffs;
  std::vector<size_t> candidates;
  for (const size_t i : of.rows) {
    StudyRow& row = a.rows[i];
    row.reference = i == *of.reference;
    row.error = error_against(row.states, of.reference_states);
    if (row.error && !row.reference) {
      const auto curvature = compare_centerlines(finest_row.folder, row.folder);
      double sum = 0;
      for (const CurvatureDifference& difference : curvature) sum += difference.mean;
      if (!curvature.empty())
        row.error->curvature_mean = sum / static_cast<double>(curvature.size());
    }
    if (!row.error || !row.finished() || (row.reference && !of.extrapolated)) continue;
    tradeoffs.push_back({row.seconds(), row.error->force_largest});
    candidates.push_back(i);
  }
  for (const size_t k : pareto_front(tradeoffs)) {
    of.front.push_back(candidates[k]);
    a.rows[candidates[k]].on_front = true;
  }
}

std::vector<StudyCase::Gap> gaps(const RecordedStates& rod, const RecordedStates& solid) {
  std::vector<StudyCase::Gap> result;
  for (const auto& state : rod)
    if (const auto difference = force_difference(state, solid))
      result.push_back({state.second.ebar, *difference});
  std::ranges::reverse(result);  // tightening
  return result;
}

}  // namespace

double StudyCase::uncertainty() const {
  double sum = 0;
  for (const KeyUncertainty& of_key : uncertainties) sum += of_key.force;
  return sum;
}

std::vector<std::string> resolution_settings(const std::vector<Dimension>& grid,
                                             const GridPoint& point, const std::string& fidelity) {
  std::vector<std::string> settings;
  for (size_t d = 0; d < grid.size(); ++d)
    if (!of_the_problem(grid[d]) && concerns(grid[d], fidelity) &&
        grid[d].key->path != "fidelities")
      settings.push_back(point.settings[d]);
  return settings;
}

std::vector<StudyCase> study_cases(const std::vector<Dimension>& grid,
                                   const std::vector<GridPoint>& points,
                                   std::vector<StudyRow>& rows, const std::string& extrapolate) {
  const Analysis a{grid, points, rows};
  std::vector<StudyCase> cases;
  for (size_t i = 0; i < rows.size(); ++i) {
    StudyCase of;
    of.fidelity = rows[i].fidelity;
    bool again = false;
    for (size_t d = 0; d < grid.size(); ++d) {
      if (of_the_problem(grid[d])) of.problem.push_back(points[rows[i].point].settings[d]);
      again = again || (!concerns(grid[d], of.fidelity) && a.at(i, d) > 0);
    }
    if (again) continue;
    auto found = std::ranges::find_if(cases, [&](const StudyCase& other) {
      return other.fidelity == of.fidelity && other.problem == of.problem;
    });
    if (found == cases.end()) found = cases.insert(cases.end(), std::move(of));
    found->rows.push_back(i);
  }
  for (StudyCase& of : cases) {
    of.reference = finest(a, of);
    if (!of.reference) continue;
    of.reference_states = judge_reference(a, extrapolate, of);
    measure(a, of);
  }
  for (StudyCase& rod : cases)
    for (const StudyCase& solid : cases)
      if (rod.fidelity == "rod" && solid.fidelity == "solid" && rod.problem == solid.problem)
        rod.from_solid = gaps(rod.reference_states, solid.reference_states);
  return cases;
}

}  // namespace bight::coupling
