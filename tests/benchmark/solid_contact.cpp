// Touching strands against closed forms, and what they cost: `solid_contact CASE CELLS ...` runs a
// case of the headers below, those of tests/solid3d/touching_rods.cpp, for each number of cells a
// section.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <map>
#include <string>

#include "tests/solid3d/bore_patch.h"
#include "tests/solid3d/clasps.h"
#include "tests/solid3d/pressed_cylinders.h"
#include "tests/solid3d/rubbing_rods.h"

using namespace bight;

namespace {

constexpr double R = 0.5, E = 2.0 / 3;  // Hertz: radius [D], E* [E]

void crossed(int cells) {
  for (const test::Pressed& p : test::crossed_cylinders(cells, 0.1, 4)) {
    const double force = 4.0 / 3 * E * std::sqrt(R) * std::pow(p.approach, 1.5);
    const double a = std::cbrt(3 * p.force * R / (4 * E)), p0 = 3 * p.force / (2 * M_PI * a * a);
    std::printf("d/R %.4f: F %.6f, over Hertz %.4f; a %.4f, %.4f; p_0 %.4f, %.4f\n", p.approach / R,
                p.force, p.force / force, p.radius, p.radius / a, p.peak, p.peak / p0);
  }
}

void parallel(int cells) {
  for (const test::Pressed& p : test::parallel_cylinders(cells, 0.1, 4)) {
    const double a = std::sqrt(2 * p.force * R / (M_PI * E)), p0 = 2 * p.force / (M_PI * a);
    std::printf("d/R %.4f: F' %.6f; a %.4f, over Hertz %.4f; p_0 %.4f, %.4f\n", p.approach / R,
                p.force, p.radius, p.radius / a, p.peak, p.peak / p0);
  }
}

void tell(const solid3d::SolidProblem& problem, const PathOutcome& outcome) {
  std::printf("%d unknowns, %d steps, %d iterations, %d cuts %s\n", problem.unknowns(),
              outcome.steps, outcome.iterations, outcome.cutbacks, outcome.reason.c_str());
}

void clasp(int cells) {
  for (const double ratio : {20.0, 1000.0})
    for (const double step : {0.1, 0.2}) {
      const std::clock_t before = std::clock();
      const test::CrossedClasp clasp(cells, ratio);
      double overlap = 0, least = 1;
      const auto outcome =
          clasp.problem->go(test::CrossedClasp::pushed, step, [&](const StepRow& row) {
            overlap = std::max(overlap, row.max_penetration);
            least = std::min(least, row.min_jacobian);
          });
      std::printf("K/mu_s %4g, steps of %g: F %.5f, overlap %.4f, J %.3f, %.1f CPU s, ", ratio,
                  step, -clasp.problem->reaction(clasp.grips).z(), overlap, least,
                  static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC);
      tell(*clasp.problem, outcome);
    }
}

void orthogonal(int cells) {
  const test::OrthogonalClasp clasp(cells);
  const auto outcome = clasp.problem->go(2.4, 0.1, [&](const StepRow& row) {
    if (row.contact_pairs == 0) return;
    const double tip = clasp.tip_pressure(), middle = clasp.middle_pressure();
    std::printf(
        "t %.2f: F %.4f, flattening %.4f, overlap %.4f, pressure at tips %.4f, middle %.4f\n",
        row.ebar, clasp.force(), clasp.flattening(), row.max_penetration, tip, middle);
  });
  tell(*clasp.problem, outcome);
}

void turned(int cells) {
  const std::vector<double> forces = test::turned_in_loop(cells, 8);
  const auto [least, most] = std::minmax_element(forces.begin(), forces.end());
  std::printf("F %.5f, ripple %.3f %%\n", forces.front(), 100 * (*most / *least - 1));
}

void capstan(int cells) {
  for (const double drum : {4.0, 8.0}) {
    const test::Capstan capstan(cells, 0.3, drum);
    const auto outcome = capstan.problem->go(capstan.enough, 0.2);
    std::printf("drum of %2g D: T1/T0 %.4f; rod %.4f, rope %.4f; ", drum, capstan.ratio(),
                std::exp(capstan.growth() * M_PI), std::exp(capstan.mu * M_PI));
    tell(*capstan.problem, outcome);
  }
}

void patch(int cells) {
  const int around = 9 * cells / 5;
  const test::PatchErrors error = test::patch(cells, around);
  std::printf("in a bore of %d cells: pressure %.3f %%, forces on nodes %.3f %% and %.3f %%\n",
              around, 100 * error.pressure, 100 * error.rod_forces, 100 * error.bore_forces);
}

void rails(int) {
  for (const double mu : {0.49, 0.50})
    std::printf("mu %.2f on a slope of 0.495: %s\n", mu,
                test::OnRails(mu).holds(0.495) ? "holds" : "slips");
  test::OnRails rod(0.5);
  for (int i = 0; i < 3; ++i) std::printf("mu 0.5, pulled: %.4f\n", rod.drag(0.03));
}

}  // namespace

int main(int count, char** words) {
  const std::map<std::string, void (*)(int)> cases = {
      {"crossed", crossed}, {"parallel", parallel}, {"clasp", clasp}, {"orthogonal", orthogonal},
      {"turned", turned},   {"capstan", capstan},   {"patch", patch}, {"rails", rails}};
  const auto found = count > 2 ? cases.find(words[1]) : cases.end();
  if (found == cases.end()) {
    std::printf(
        "solid_contact crossed|parallel|clasp|orthogonal|turned|capstan|patch|rails CELLS ...\n");
    return 2;
  }
  for (int i = 2; i < count; ++i) {
    const std::clock_t before = std::clock();
    std::printf("%s, %s cells a section\n", words[1], words[i]);
    found->second(std::atoi(words[i]));
    std::printf("%.1f CPU s\n", static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC);
    std::fflush(stdout);
  }
}
