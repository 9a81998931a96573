#pragma once

#include "mechanics/types.h"

namespace bight::rod1d {

/// A number that depends on N variables, with its gradient and Hessian: second derivatives of
/// rational expressions by the rules of sum, product and quotient.
template <int N>
struct Jet {
  double value = 0;
  Eigen::Matrix<double, N, 1> gradient = Eigen::Matrix<double, N, 1>::Zero();
  Eigen::Matrix<double, N, N> hessian = Eigen::Matrix<double, N, N>::Zero();

  Jet(double constant = 0) : value(constant) {}
  static Jet variable(double value, int index) {
    Jet x(value);
    x.gradient[index] = 1;
    return x;
  }

  friend Jet operator+(Jet a, const Jet& b) {
    a.value += b.value, a.gradient += b.gradient, a.hessian += b.hessian;
    return a;
  }
  friend Jet operator-(const Jet& a, const Jet& b) { return a + b * -1.0; }
  friend Jet operator*(Jet a, double b) {
    a.value *= b, a.gradient *= b, a.hessian *= b;
    return a;
  }
  friend Jet operator*(double a, const Jet& b) { return b * a; }
  friend Jet operator*(const Jet& a, const Jet& b) {
    Jet c(a.value * b.value);
    c.gradient = a.value * b.gradient + b.value * a.gradient;
    c.hessian = a.value * b.hessian + b.value * a.hessian + a.gradient * b.gradient.transpose() +
                b.gradient * a.gradient.transpose();
    return c;
  }
  friend Jet operator/(const Jet& a, const Jet& b) { return a * inverse(b); }

  /// f(a), given f and its first two derivatives there.
  static Jet compose(const Jet& a, double f, double df, double ddf) {
    Jet c(f);
    c.gradient = df * a.gradient;
    c.hessian = df * a.hessian + ddf * a.gradient * a.gradient.transpose();
    return c;
  }

 private:
  static Jet inverse(const Jet& b) {
    const double f = 1 / b.value;
    return compose(b, f, -f * f, 2 * f * f * f);
  }
};

}  // namespace bight::rod1d
