#include <catch2/catch.hpp>
#include <cmath>

#include "mechanics/newton.h"
#include "rod1d/effects/bend.h"
#include "rod1d/effects/load.h"
#include "rod1d/effects/stretch.h"
#include "rod1d/measure.h"

using namespace bight;
using namespace bight::rod1d;

namespace {

/// A rod of unit bending stiffness and length along z, hardly extensible, clamped at the start. The
/// first segment lies half inside the clamp: bending begins at the middle of it.
struct Column {
  Rod rod;
  Vector x;
  std::vector<bool> held;
  EffectList effects;

  Column(int segments, double stretching_stiffness, double length = 1) {
    const double h = length / (segments - 0.5);
    rod.rest_length.assign(segments, h);
    rod.bending_stiffness = 1;
    rod.stretching_stiffness = stretching_stiffness;
    x = Vector::Zero(3 * rod.nodes());
    for (int i = 0; i < rod.nodes(); ++i) x[3 * i + 2] = (i - 0.5) * h;
    held.assign(x.size(), false);
    for (int c = 0; c < 6; ++c) held[c] = true;
    effects.push_back(std::make_unique<Stretch>(rod));
    effects.push_back(std::make_unique<Bend>(rod));
  }
  std::vector<int> blocks() const {
    std::vector<int> first;
    for (int i = 0; i < rod.nodes(); ++i) first.push_back(3 * i);
    return first;
  }
  int tip() const { return 3 * (rod.nodes() - 1); }

  void solve() {
    const Unknowns unknowns(blocks(), static_cast<int>(x.size()), held);
    Assembler assembler(unknowns, effects);
    SparseCholesky cholesky;
    System system{assembler, cholesky, Ordering::natural,
                  [&](Vector& at, const Vector& dx) { unknowns.advance(at, dx); }};
    NewtonOptions options;
    options.max_iterations = 300;
    options.energy_tolerance = 1e-12;
    options.force_tolerance = 1e-5;  // round-off of EA/h
    options.bound.first_rise = 1e-9;
    const NewtonResult result = newton(system, x, options);
    INFO(result.reason);
    REQUIRE(result.ok());
    x = result.x;
  }

  bool stable() const {
    const Unknowns unknowns(blocks(), static_cast<int>(x.size()), held);
    Assembler assembler(unknowns, effects);
    return bight::stable(assembler, x);
  }
};

/// Tip of a cantilever under a dead load a = P L^2/B across: sideways and shortening, over L.
Vector2 tip_under(double a, int segments) {
  Column column(segments, 1e6);
  auto load = std::make_unique<Load>();
  load->add(column.rod.nodes() - 1, Vector3(a, 0, 0));
  column.effects.push_back(std::move(load));
  column.solve();
  return {column.x[column.tip()], 1 - column.x[column.tip() + 2]};
}

/// Load at which a straight column, pressed uniformly, ceases to be stable.
double buckling_load(int segments, bool clamped_above) {
  const double EA = 1e6;
  double low = 0, high = 100;
  for (int i = 0; i < 40; ++i) {
    const double load = 0.5 * (low + high);
    // Clamped above: half a segment more is inside the upper clamp.
    Column column(segments, EA, clamped_above ? (segments - 0.5) / (segments - 1.0) : 1.0);
    column.x *= 1 - load / EA;
    if (clamped_above)
      for (size_t c = column.held.size() - 6; c < column.held.size(); ++c) column.held[c] = true;
    (column.stable() ? low : high) = load;
  }
  return low;
}

}  // namespace

TEST_CASE("cantilever under a dead load follows the elastica") {
  // Bisshopp and Drucker 1945; a = P L^2/B.
  struct Row {
    double a, w, u;
  };
  const auto row = GENERATE(Row{1, 0.30172, 0.05643}, Row{2, 0.49346, 0.16064},
                            Row{5, 0.71379, 0.38763}, Row{10, 0.81061, 0.55500});
  const Vector2 exact(row.w, row.u);
  const double coarse = (tip_under(row.a, 25) - exact).norm();
  const double fine = (tip_under(row.a, 100) - exact).norm();
  INFO("a = " << row.a << ": errors " << coarse << ", " << fine);
  CHECK(fine < 3e-4);
  CHECK(fine < coarse / 8 + 1e-5);  // second order; the table has five digits
}

TEST_CASE("cantilever under a = 7 follows the elastica by elliptic integrals") {
  // Bisshopp and Drucker 1945: sqrt(a) = K(k) - F(phi, k), sin(phi) = 1/(k sqrt 2), and
  // w/L = 1 - 2 (E(k) - E(phi, k))/sqrt(a), 1 - u/L = sqrt(2 (2 k^2 - 1)/a).
  const double a = 7;
  double low = std::sqrt(0.5), high = 1;
  const auto phi = [](double k) { return std::asin(std::min(1.0, std::sqrt(0.5) / k)); };
  for (int i = 0; i < 100; ++i) {
    const double k = 0.5 * (low + high);
    (std::comp_ellint_1(k) - std::ellint_1(k, phi(k)) < std::sqrt(a) ? low : high) = k;
  }
  const double k = low;
  const Vector2 exact(1 - 2 * (std::comp_ellint_2(k) - std::ellint_2(k, phi(k))) / std::sqrt(a),
                      1 - std::sqrt(2 * (2 * k * k - 1) / a));
  const double coarse = (tip_under(a, 25) - exact).norm();
  const double fine = (tip_under(a, 50) - exact).norm();
  INFO("exact " << exact.transpose() << ": errors " << coarse << ", " << fine);
  CHECK(fine < 1e-3);
  CHECK(coarse / fine == Approx(4).epsilon(0.1));
}

TEST_CASE("end moments 2 pi B/L bend a rod to a full circle") {
  const auto energy_and_force = [](int segments) {
    Rod rod;
    rod.rest_length.assign(segments, 1.0 / segments);
    rod.bending_stiffness = 1;
    // Nodes of a polygon whose sides have their rest length.
    const double turn = 2 * M_PI / segments, radius = 0.5 / segments / std::sin(0.5 * turn);
    Vector x(3 * rod.nodes());
    for (int i = 0; i < rod.nodes(); ++i)
      x.segment<3>(3 * i) = radius * Vector3(std::cos(turn * i), std::sin(turn * i), 0);
    Bend bend(rod);
    double energy = 0;
    Vector gradient = Vector::Zero(x.size());
    for (int i = 0; i < bend.stencils(); ++i) {
      double g[9] = {}, h[81] = {};
      ElementSlot slot{0, g, h};
      bend.element(x, i, Order::gradient, slot);
      energy += slot.energy;
      for (int k = 0; k < 9; ++k) gradient[bend.coordinates(i)[k]] += g[k];
    }
    // Constant moment: nodes away from the ends are in balance.
    const double inner = gradient.segment(6, x.size() - 12).cwiseAbs().maxCoeff();
    CHECK(inner < 1e-9);
    for (const double kappa : curvature(rod, x))
      if (kappa > 0) CHECK(kappa == Approx(2 * M_PI).epsilon(10.0 / (segments * segments)));
    // The half segments at both ends stay straight.
    return energy / (1 - 1.0 / segments);
  };
  const double exact = 2 * M_PI * M_PI;
  const double coarse = energy_and_force(40) / exact - 1, fine = energy_and_force(80) / exact - 1;
  CHECK(std::abs(fine) < 1.1e-3);
  CHECK(coarse / fine == Approx(4).epsilon(0.02));
}

TEST_CASE("straight columns buckle at Euler's loads") {
  const double cantilever = 0.25 * M_PI * M_PI, clamped = 4 * M_PI * M_PI;
  CHECK(buckling_load(100, false) == Approx(cantilever).epsilon(1e-3));
  CHECK(buckling_load(100, true) == Approx(clamped).epsilon(2e-3));
  const double coarse = buckling_load(20, true) - clamped, fine = buckling_load(40, true) - clamped;
  CHECK(coarse / fine == Approx(4).epsilon(0.15));
}
