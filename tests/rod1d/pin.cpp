#include "rod1d/pin.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "rod1d/overhand.h"
#include "rod1d/rod_model.h"
#include "rod1d/run_rod.h"

using namespace bight;
using namespace bight::rod1d;

TEST_CASE("a turn about the axis brings a node to y = 0 and moves the frames along") {
  const Rod rod = uniform_rod(2, 2, 0.5);
  Vector x(11);
  x << 0, 0, -1, -3, 4, 0, 1, 1, 1, 0.1, 0.2;
  CHECK(farthest_node(rod, x) == 1);
  CHECK(radius_of(x, 1) == Approx(5));
  Frames frames = twist_free_frames(rod, x);
  const Matrix3 by = turn_to_x(x, 1);
  const Vector3 normal = frames.normal[1];
  turn(rod, by, x);
  turn(by, frames);
  CHECK((x.segment<3>(3) - Vector3(5, 0, 0)).norm() < 1e-14);
  CHECK(x[8] == 1);
  CHECK(x.tail(2) == Vector2(0.1, 0.2));
  const Vector3 tangent = (x.segment<3>(6) - x.segment<3>(3)).normalized();
  CHECK((frames.tangent[1] - tangent).norm() < 1e-14);
  CHECK((frames.normal[1] - by * normal).norm() < 1e-14);
  CHECK(farthest_node(rod, Vector::Zero(9)) == -1);
}

TEST_CASE("a knot that is given turned about its axis is pulled as the one that is not") {
  RodParameters parameters;
  parameters.segments = 120;
  parameters.follow_knot = false;
  parameters.path.waypoints = {28, 26};
  double tension[2];
  for (const int k : {0, 1}) {
    const Polyline line = overhand_start(parameters.length, 28, 400);
    const Matrix3 by =
        Eigen::AngleAxisd(k * 1.3, Vector3::UnitZ()).toRotationMatrix();  // no angle is special
    parameters.start.clear();
    for (const Vector3& p : line) parameters.start.push_back(by * p);
    const RodResult result = run_rod(parameters);
    REQUIRE(result.outcome.status == PathStatus::finished);
    CHECK(result.outcome.cutbacks == 0);
    tension[k] = result.steps.back().tension;
  }
  CHECK(tension[0] == Approx(tension[1]).epsilon(1e-6));
}
