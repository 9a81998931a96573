// What each element of the solid buys: `solid_elements rod CELLS ...` errors of B, EA, C of a
// straight rod and seconds of a Newton iteration; `solid_elements CASE N ...` a case of
// tests/solid3d/verification.h.

#include <cstdio>
#include <cstdlib>

#include "tests/solid3d/straight_rod.h"
#include "tests/solid3d/verification.h"

using namespace bight;

namespace {

void rod(const solid3d::HexElement& element, int cells) {
  const test::RodOf of{.cells = cells, .element = std::string(element.name)};
  const test::RodErrors error = test::rod_errors(of);
  const test::RodSolution bent = test::bent_rod(of, 15, {0.02, 0, 0});
  std::printf("%8d  B %+7.3f %%  EA %+7.3f %%  C %+7.3f %%  %d unknowns, %.3f CPU s an iteration\n",
              cells, 100 * error.B, 100 * error.EA, 100 * error.C, bent.unknowns,
              bent.cpu_seconds / bent.newton.factorisations);
}

void verify(const std::string& name, const solid3d::HexElement& element, int n) {
  if (name == "torsion") {
    const test::TorsionErrors error = test::torsion(element, n, 2);
    std::printf("%8d  M %+.3f %%  N %+.3f %%\n", n, 100 * error.moment, 100 * error.force);
  } else if (name == "tube") {
    std::printf("%8d  %.5f\n", n, test::thick_tube(element, n));
  } else if (name == "cook") {
    std::printf("%8d  compressible %.3f mm, plane strain %.3f mm; near-incompressible %.3f mm\n", n,
                test::cook_compressible(element, n, false),
                test::cook_compressible(element, n, true), test::cook_incompressible(element, n));
  } else if (name == "block") {
    std::printf("%8d  %.3f mm\n", n, test::partly_pressed_block(element, n));
  }
}

}  // namespace

int main(int count, char** words) {
  const std::string name = count > 1 ? words[1] : "";
  if (count < 3 || !(name == "rod" || name == "torsion" || name == "tube" || name == "cook" ||
                     name == "block")) {
    std::printf("solid_elements rod|torsion|tube|cook|block N ...\n");
    return 2;
  }
  for (const solid3d::HexElement& element : solid3d::hex_elements()) {
    std::printf("%s\n", std::string(element.name).c_str());
    for (int i = 2; i < count; ++i)
      name == "rod" ? rod(element, std::atoi(words[i]))
                    : verify(name, element, std::atoi(words[i]));
  }
}
