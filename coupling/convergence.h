#pragma once

#include <array>
#include <optional>
#include <vector>

namespace bight::coupling {

/// Order p of an error C h^p, from the differences |f2 - f1| and |f3 - f2| of results at sizes
/// h1 < h2 < h3: (h3^p - h2^p)/(h2^p - h1^p) = |f3 - f2|/|f2 - f1| (Celik et al. 2008, J. Fluids
/// Eng. 130, 078001). Nothing when there is no such p between 0.4 and 8: differences that hardly
/// fall are noise.
std::optional<double> observed_order(const std::array<double, 3>& h, double difference12,
                                     double difference23);

/// Error left in f1, as a multiple of f1 - f2 (Richardson 1911): h1^p/(h2^p - h1^p).
double error_left(double h1, double h2, double p);

/// What a run costs and how wrong it is.
struct Tradeoff {
  double seconds, error;
};

/// Runs than which no other is both cheaper and better, the cheapest first.
std::vector<size_t> pareto_front(const std::vector<Tradeoff>& runs);

/// The cheapest run whose error is at most `level`.
std::optional<size_t> cheapest(const std::vector<Tradeoff>& runs, double level);

}  // namespace bight::coupling
