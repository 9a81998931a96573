#include "solid3d/effects/grip.h"

#include <catch2/catch.hpp>

#include "tests/solid3d/shapes.h"

using namespace bight;
using namespace bight::solid3d;

TEST_CASE("grips move apart alike, and know their turns and their pull") {
  const Mesh mesh = test::straight_mesh(12, 2.0, 1.0);
  const Grip grip{true, true, {}};
  const int last = mesh.node(mesh.layers() - 1, 0), angles = 3 * mesh.nodes();
  Vector x = test::reference_state(mesh, 2);
  grip.move(mesh, 0.5, x);
  for (int p = 0; p < mesh.points_per_layer(); ++p) {
    CHECK(x[3 * p + 2] == -0.75);
    CHECK(x[3 * (last + p) + 2] == 0.75);
  }
  x[angles] = 0.3;
  x[angles + 1] = -0.2;
  CHECK(grip.turn(mesh, x) == Approx(0.5));
  CHECK(grip.start_turn(mesh, x) == Approx(-0.2));
  CHECK(Grip{true, false, {}}.turn(mesh, x) == Approx(0.3));

  Vector gradient = Vector::Zero(x.size());
  gradient[2] = -1;
  gradient[3 * last + 2] = 2;
  x[3 * last] = 0.4, x[3 * last + 1] = 0.3;
  gradient[3 * last] = -5, gradient[3 * last + 1] = 7;
  CHECK(grip.tension(mesh, x, gradient).torque == Approx(0.4 * 7 + 0.3 * 5));
  CHECK(grip.tension(mesh, x, gradient).start == 1);
  CHECK(grip.tension(mesh, x, gradient).finish == 2);
}
