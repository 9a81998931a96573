#include "coupling/validity.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "coupling/write_csv.h"

namespace bight::coupling {
namespace {

/// c, and the factor by which it has been found to differ from knot to knot, at most.
constexpr double calibrated = 1.7, spread = 1.6;
/// An error of first order says no more than "more" above this.
constexpr double largest_meant = 0.3;
/// Slopes are taken over states this near [of ebar, at least one diameter].
constexpr double window = 0.1;

/// The rows of the first tightening that know of contact.
std::vector<StepRow> first_tightening(const std::vector<StepRow>& rows) {
  std::vector<StepRow> leg;
  for (const StepRow& row : rows) {
    if (!leg.empty() && row.ebar > leg.back().ebar) break;
    if (!leg.empty() && row.ebar == leg.back().ebar) leg.pop_back();
    leg.push_back(row);
  }
  std::erase_if(leg, [](const StepRow& r) { return !(r.flattening > 0 && r.tension > 0); });
  return leg;
}

/// d ln U/d ebar at a state, by least squares over those near it.
std::optional<double> slope(const std::vector<StepRow>& leg, double ebar) {
  const double reach = std::max(1.0, window * ebar);
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (const StepRow& row : leg) {
    const double d = row.ebar - ebar, u = std::log(row.flattening);
    if (std::abs(d) > reach) continue;
    n += 1, x += d, y += u, xx += d * d, xy += d * u;
  }
  const double spread_of_ebar = n * xx - x * x;
  if (n < 3 || spread_of_ebar < 1e-12) return std::nullopt;
  return (n * xy - x * y) / spread_of_ebar;
}

/// Where the error first reaches `level`.
std::optional<double> reached_at(const std::vector<RodError>& errors, double level) {
  for (size_t i = 0; i < errors.size(); ++i) {
    if (errors[i].relative < level) continue;
    if (i == 0) return errors[0].ebar;
    const RodError &a = errors[i - 1], &b = errors[i];
    return a.ebar + (b.ebar - a.ebar) * (level - a.relative) / (b.relative - a.relative);
  }
  return std::nullopt;
}

}  // namespace

std::vector<RodError> rod_errors(const std::vector<StepRow>& rows) {
  const std::vector<StepRow> leg = first_tightening(rows);
  std::vector<RodError> errors;
  for (const StepRow& row : leg) {
    if (const auto rate = slope(leg, row.ebar))
      errors.push_back({row.ebar, calibrated * -*rate * row.flattening / row.tension});
    if (!errors.empty() && errors.back().relative > largest_meant) break;
  }
  return errors;
}

std::optional<ValidDownTo> valid_down_to(const std::vector<RodError>& errors, double level) {
  if (errors.empty() || errors.front().relative > level) return std::nullopt;
  ValidDownTo valid;
  const double last = errors.back().ebar;
  const auto at = reached_at(errors, level);
  valid.reached = at.has_value();
  valid.ebar = at.value_or(last);
  valid.earliest = reached_at(errors, level / spread).value_or(last);
  valid.latest = reached_at(errors, level * spread).value_or(last);
  return valid;
}

void write_rod_errors(const std::filesystem::path& file, const std::vector<RodError>& errors) {
  std::vector<double> ebar, error;
  for (const RodError& at : errors) {
    ebar.push_back(at.ebar);
    error.push_back(at.relative);
  }
  if (!errors.empty()) write_csv(file, {{"ebar", ebar}, {"estimated_error", error}});
}

std::string validity_sentence(const std::vector<RodError>& errors, double level) {
  if (errors.empty()) return "no estimate of the rod's error: no contact, or too few steps";
  const auto valid = valid_down_to(errors, level);
  const double percent = 100 * level;
  if (!valid)
    return fmt::format("rod estimated more than {:.3g} % off from the start, ebar = {:.4g}",
                       percent, errors.front().ebar);
  if (!valid->reached)
    return fmt::format("rod estimated within {:.3g} % along the whole path", percent);
  return fmt::format("rod estimated within {:.3g} % down to ebar = {:.3g} ({:.3g} to {:.3g})",
                     percent, valid->ebar, valid->earliest, valid->latest);
}

}  // namespace bight::coupling
