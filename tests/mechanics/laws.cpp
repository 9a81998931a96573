#include <catch2/catch.hpp>

#include "mechanics/contact_law.h"
#include "mechanics/friction_law.h"

using namespace bight;

namespace {

/// |f'(x) - derivative| by central differences at h and h/2.
template <class F>
void check_slope(F&& f, double x, double derivative, double h) {
  const auto error = [&](double step) {
    return std::abs((f(x + step) - f(x - step)) / (2 * step) - derivative);
  };
  const double round_off = 1e-15 * (std::abs(f(x)) + std::abs(derivative * x)) / h;
  INFO("x = " << x << ": errors " << error(h) << ", " << error(0.5 * h));
  CHECK((error(0.5 * h) < 0.3 * error(h) || error(0.5 * h) < 10 * round_off + 1e-14));
}

}  // namespace

TEST_CASE("contact law: slope and curvature belong to the energy") {
  const ContactLaw law{7.0, 0.01};
  // Open, inside the onset on both sides of zero, and in the linear range.
  for (const double gap : {0.02, 0.0049, 0.001, -0.001, -0.0049, -0.02}) {
    check_slope([&](double g) { return law.energy(g); }, gap, law.slope(gap), 5e-5);
    check_slope([&](double g) { return law.slope(g); }, gap, law.curvature(gap), 5e-5);
  }
}

TEST_CASE("contact law: continuous up to the curvature where its pieces meet") {
  const ContactLaw law{7.0, 0.01};
  for (const double meet : {0.005, -0.005}) {
    const double a = meet - 1e-12, b = meet + 1e-12;
    CHECK(law.energy(a) == Approx(law.energy(b)).margin(1e-10));
    CHECK(law.slope(a) == Approx(law.slope(b)).margin(1e-10));
    CHECK(law.curvature(a) == Approx(law.curvature(b)).margin(1e-7));
  }
  CHECK(law.energy(0.005) == 0);
  CHECK(law.slope(-0.02) == Approx(-7.0 * 0.02));
  CHECK(law.touches(0.0049));
  CHECK_FALSE(law.touches(0.0051));
}

TEST_CASE("friction law: slope and curvature belong to the energy, sticking and sliding") {
  const FrictionLaw law{5.0, 0.3};
  CHECK(law.elastic_slip() == Approx(0.06));
  for (const double slip : {0.01, 0.055, 0.065, 0.4}) {
    check_slope([&](double s) { return law.energy(s); }, slip, law.slope(slip), 5e-4);
    check_slope([&](double s) { return law.slope(s); }, slip, law.curvature(slip), 5e-4);
    CHECK(law.slope_over_slip(slip) * slip == Approx(law.slope(slip)));
  }
  CHECK(law.slope_over_slip(0) == 5.0);
  CHECK(law.energy(0.06 - 1e-12) == Approx(law.energy(0.06 + 1e-12)));
  CHECK(law.slope(0.06 - 1e-12) == Approx(law.slope(0.06 + 1e-12)));
}

TEST_CASE("friction law: work is stored energy plus dissipation, which never falls") {
  const FrictionLaw law{5.0, 0.3};
  double last = 0;
  for (double slip = 0; slip < 0.5; slip += 0.01) {
    const double stored = 0.5 * law.slope(slip) * law.slope(slip) / law.stick_stiffness;
    CHECK(law.energy(slip) == Approx(stored + law.dissipated(slip)).margin(1e-15));
    CHECK(law.dissipated(slip) >= last);
    last = law.dissipated(slip);
  }
}
