#include "coupling/convergence.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace bight::coupling {

std::optional<double> observed_order(const std::array<double, 3>& h, double difference12,
                                     double difference23) {
  if (!(difference12 > 0) || !(difference23 > 0)) return std::nullopt;
  const double measured = difference23 / difference12;
  // Rises with p.
  const auto ratio = [&](double p) {
    return (std::pow(h[2], p) - std::pow(h[1], p)) / (std::pow(h[1], p) - std::pow(h[0], p));
  };
  double low = 0.4, high = 8;
  if (measured < ratio(low) || measured > ratio(high)) return std::nullopt;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (ratio(middle) < measured ? low : high) = middle;
  }
  return low;
}

double error_left(double h1, double h2, double p) { return 1 / (std::pow(h2 / h1, p) - 1); }

std::vector<size_t> pareto_front(const std::vector<Tradeoff>& runs) {
  std::vector<size_t> order(runs.size()), front;
  std::iota(order.begin(), order.end(), size_t{0});
  std::ranges::stable_sort(order, [&](size_t a, size_t b) {
    return runs[a].seconds != runs[b].seconds ? runs[a].seconds < runs[b].seconds
                                              : runs[a].error < runs[b].error;
  });
  for (const size_t i : order)
    if (front.empty() || runs[i].error < runs[front.back()].error) front.push_back(i);
  return front;
}

std::optional<size_t> cheapest(const std::vector<Tradeoff>& runs, double level) {
  std::optional<size_t> best;
  for (size_t i = 0; i < runs.size(); ++i)
    if (runs[i].error <= level && (!best || runs[i].seconds < runs[*best].seconds)) best = i;
  return best;
}

}  // namespace bight::coupling
