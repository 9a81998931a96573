#pragma once

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "mechanics/effect.h"

namespace bight::test {

/// Energy, gradient and Hessian times a direction of a whole effect at x.
struct Evaluation {
  double energy = 0;
  Vector gradient, product;
};

inline Evaluation evaluate(Effect& effect, Vector x, const Vector& direction) {
  effect.settle(x);
  effect.refresh(x);
  Evaluation out{0, Vector::Zero(x.size()), Vector::Zero(x.size())};
  for (int s = 0; s < effect.stencils(); ++s) {
    const auto coordinates = effect.coordinates(s);
    const int m = static_cast<int>(coordinates.size());
    Vector gradient = Vector::Zero(m), local(m);
    Eigen::MatrixXd hessian = Eigen::MatrixXd::Zero(m, m);
    ElementSlot slot{0, gradient.data(), hessian.data()};
    effect.element(x, s, Order::hessian, slot);
    for (int i = 0; i < m; ++i) local[i] = direction[coordinates[i]];
    const Vector product = hessian * local;
    out.energy += slot.energy;
    for (int i = 0; i < m; ++i) {
      out.gradient[coordinates[i]] += gradient[i];
      out.product[coordinates[i]] += product[i];
    }
  }
  return out;
}

/// The error of a central difference must fall with the square of its step: every halving divides
/// it by at least `least` (4 for a smooth energy), until only round-off is left. A wrong derivative
/// leaves an error that no longer falls.
struct OrderOfConvergence {
  double first_step = 1e-3;
  int halvings = 8;
  double least = 3.0;

  template <class ErrorAt, class FloorAt>
  void check(const std::string& what, ErrorAt&& error_at, FloorAt&& floor_at) const {
    double h = first_step, last = error_at(h);
    INFO(what);
    for (int k = 0; k < halvings; ++k) {
      h *= 0.5;
      const double error = error_at(h), floor = floor_at(h);
      INFO("step " << h << ": error " << error << " after " << last << ", round-off " << floor);
      CHECK((error <= floor || error * least <= last));
      last = std::max(error, floor);
    }
  }
};

/// Checks gradient and Hessian of an effect along random directions in the first `coordinates`
/// coordinates (those behind are internal).
inline void check_derivatives(Effect& effect, const Vector& x, int coordinates,
                              const OrderOfConvergence& order = {}) {
  std::mt19937 generator(7);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 3; ++trial) {
    Vector v = Vector::Zero(x.size());
    for (int i = 0; i < coordinates; ++i) v[i] = normal(generator);
    v /= v.cwiseAbs().maxCoeff();
    const Evaluation here = evaluate(effect, x, v);
    // What is summed before it cancels sets the round-off: take it from the neighbourhood.
    const Evaluation near = evaluate(effect, x + order.first_step * v, v);
    const double energies = std::abs(here.energy) + std::abs(near.energy);
    const double forces = here.gradient.cwiseAbs().sum() + near.gradient.cwiseAbs().sum();
    const double stiffness = here.product.cwiseAbs().sum() + near.product.cwiseAbs().sum();
    const double size = 1 + x.cwiseAbs().maxCoeff();
    const std::string name(effect.name());
    order.check(
        name + ", gradient",
        [&](double h) {
          const double difference =
              evaluate(effect, x + h * v, v).energy - evaluate(effect, x - h * v, v).energy;
          return std::abs(difference / (2 * h) - here.gradient.dot(v));
        },
        [&](double h) { return 1e-14 * (energies + size * forces) / h; });
    order.check(
        name + ", Hessian",
        [&](double h) -> double {
          const Vector difference =
              evaluate(effect, x + h * v, v).gradient - evaluate(effect, x - h * v, v).gradient;
          return (difference / (2 * h) - here.product).norm();
        },
        [&](double h) { return 1e-14 * (forces + size * stiffness) / h; });
  }
}

}  // namespace bight::test
