#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "solid3d/effects.h"
#include "solid3d/section_motion.h"
#include "solid3d/surface_pairs.h"
#include "tests/derivatives.h"
#include "tests/solid3d/shapes.h"

using namespace bight;
using namespace bight::solid3d;

namespace {

/// A thin strand lying across a thick one of another section, overlapping it a little.
struct Crossing {
  static constexpr double thick = 1.5, overlap = 0.02;
  std::vector<Mesh> strands;
  SolidEffects effects;

  Crossing() {
    strands.push_back(test::straight_mesh(12, 3.0, 1.0));
    strands.push_back(make_mesh(scaled(make_section(32), thick), strands[0].s, strands[0].nodes()));
    SolidParameters parameters;
    parameters.material.bulk_to_shear = 20;
    parameters.sample_spacing = 0.1;
    effects = make_effects(strands, parameters, positions());
  }
  int positions() const { return 3 * (strands[0].nodes() + strands[1].nodes()); }
  int cells() const { return static_cast<int>(strands[0].cells.size() + strands[1].cells.size()); }
  Vector state() const {
    Vector x = Vector::Zero(positions() + 2 * cells());
    const Matrix3 across = Eigen::AngleAxisd(M_PI / 2, Vector3::UnitX()).toRotationMatrix();
    const Vector3 middle(0, 0, 1.5), aside(0.5 + 0.5 * thick - overlap, 0.1, 0);
    for (int n = 0; n < strands[0].nodes(); ++n) x.segment<3>(3 * n) = strands[0].reference(n);
    for (int n = strands[1].first_node; 3 * n < positions(); ++n)
      x.segment<3>(3 * n) = middle + across * (strands[1].reference(n) - middle) + aside;
    return x;
  }
};

}  // namespace

TEST_CASE("a scaled section is that of a disc of its diameter") {
  const Section section = scaled(make_section(32), 1.5);
  CHECK(section.second_moment() == Approx(M_PI / 64 * std::pow(1.5, 4)));
  CHECK(scaled(section, 1).second_moment() == Approx(M_PI / 64));
}

TEST_CASE("nodes and cells of strands are numbered one behind the other") {
  const Crossing crossing;
  const HexMesh all = hexahedra(crossing.strands);
  REQUIRE(3 * static_cast<int>(all.nodes.size()) == crossing.positions());
  const Mesh& second = crossing.strands[1];
  CHECK(all.nodes[second.node(2, 5)] == second.reference(second.node(2, 5)));
  CHECK(second.reference(second.first_node).z() == 0);
  int least = second.first_node + second.nodes();
  for (size_t c = crossing.strands[0].cells.size(); c < all.cells.size(); ++c)
    for (const int n : all.cells[c]) least = std::min(least, n);
  CHECK(least == second.first_node);
}

TEST_CASE("patches of strands with different sections know their place") {
  const Crossing crossing;
  const ContactSurface surface(crossing.strands);
  for (int patch = 0; patch < surface.patches(); ++patch)
    CHECK(surface.patch(surface.around(patch), surface.along(patch)) == patch);
  const int last = crossing.strands[0].layers() - 1;
  CHECK_FALSE(surface.has_patch(last));
  CHECK_FALSE(surface.has_patch(last + 1));
  CHECK(surface.has_patch(last + 2));
  CHECK(surface.strand_of(last) == 0);
  CHECK(surface.strand_of(last + 1) == 1);
  CHECK(surface.node(surface.patch(3, last + 3)) ==
        crossing.strands[1].node(2, crossing.strands[1].section.rim[3]));
  CHECK(surface.patch(-1, 2) == surface.patch(7, 2));
  CHECK(surface.patch(-1, last + 3) == surface.patch(15, last + 3));
  // The skin of each is a cylinder of its diameter.
  const Vector x = crossing.state();
  for (const double u : {0.2, 5.7}) {
    const SurfacePoint thin = surface.evaluate(x, surface.weights(u, 3.3));
    CHECK(thin.y.head<2>().norm() + surface.skin(3) == Approx(0.5).epsilon(1e-12));
  }
  double area = 0;
  for (int k = last + 1; k < surface.layers(); ++k)
    if (surface.has_patch(k)) area += surface.sides(k) * surface.area(surface.patch(0, k));
  CHECK(area == Approx(M_PI * Crossing::thick * (3.0 - crossing.strands[1].s[1])));
}

TEST_CASE("a projection stays on the strand where it begins") {
  const Crossing crossing;
  const ContactSurface surface(crossing.strands);
  const Vector x = crossing.state();
  const int layers = crossing.strands[0].layers();
  const Vector3 between(0.5, 0.05, 1.5);
  for (const int strand : {0, 1}) {
    const Vector2 start(strand == 0 ? 2 : 10, strand * layers + layers / 2);
    const auto uv = surface.project(x, between, start);
    REQUIRE(uv);
    CHECK(surface.strand_of(static_cast<int>(std::lround(uv->y()))) == strand);
  }
  // Beyond the end of the first strand there is nothing, though the second follows in number.
  CHECK_FALSE(surface.project(x, {0.6, 0, 3.2}, {2, layers - 2}));
  CHECK_FALSE(surface.project(x, {0.6, 0, -0.2}, {2, 1}));
}

TEST_CASE("strands are near each other whatever their arc lengths, a straight one not itself") {
  const Crossing crossing;
  const ContactSurface surface(crossing.strands);
  const auto near = near_patches(surface, crossing.state(), 0.05, 1.5);
  int pairs = 0;
  for (int p = 0; p < surface.patches(); ++p)
    for (const int q : near[p]) {
      ++pairs;
      CHECK(surface.strand_of(surface.along(p)) != surface.strand_of(surface.along(q)));
    }
  CHECK(pairs > 10);
}

TEST_CASE("two strands touch by the sum of their radii, with balanced forces") {
  Crossing crossing;
  Contact& contact = *crossing.effects.contact;
  const Vector x = crossing.state();
  contact.refresh(x);
  CHECK(contact.max_penetration() == Approx(Crossing::overlap).margin(3e-3));
  const auto at = test::evaluate(contact, x, Vector::Zero(x.size()));
  double energy = 0;
  for (const auto& sample : contact.samples())
    if (sample.faces) energy += sample.weight * contact.law().energy(sample.gap);
  CHECK(at.energy == Approx(energy));
  Vector3 force[2] = {Vector3::Zero(), Vector3::Zero()}, torque = Vector3::Zero();
  for (int i = 0; i < crossing.positions(); i += 3) {
    const Vector3 f = at.gradient.segment<3>(i);
    force[i / 3 >= crossing.strands[1].first_node] += f;
    torque += Vector3(x.segment<3>(i)).cross(f);
  }
  CHECK(force[0].x() > 1e-4);
  CHECK((force[0] + force[1]).norm() < 1e-11 * force[0].norm());
  CHECK(torque.norm() < 1e-10 * force[0].norm());
  test::check_derivatives(contact, test::shaken(x, crossing.positions(), 1e-3),
                          crossing.positions(), {1e-4, 4, 3.0});
}

TEST_CASE("sections of every strand turn by themselves") {
  const Crossing crossing;
  const Vector x = crossing.state();
  const Vector3 w(0.2, -0.1, 0.4), about(0, 0, 1.5);
  const Matrix3 R = Eigen::AngleAxisd(w.norm(), w.normalized()).toRotationMatrix();
  Vector dx = Vector::Zero(x.size()), moved = x;
  // The second strand turns, linearly; the first stays.
  for (int n = crossing.strands[1].first_node; 3 * n < crossing.positions(); ++n)
    dx.segment<3>(3 * n) = w.cross(Vector3(x.segment<3>(3 * n)) - about);
  dx[dx.size() - 1] = 0.5;
  advance_sections(crossing.strands, moved, dx);
  CHECK(moved[moved.size() - 1] == 0.5);
  CHECK(moved.head(3 * crossing.strands[0].nodes()) == x.head(3 * crossing.strands[0].nodes()));
  const Mesh& second = crossing.strands[1];
  const auto before = section_places(second, x), after = section_places(second, moved);
  for (int k = 0; k < second.layers(); ++k)
    CHECK((after[k].rotation - R * before[k].rotation).norm() < 1e-10);
  // And so it goes on.
  const Vector next = extrapolate_sections(crossing.strands, {{0, x}, {1, moved}}, 2);
  const auto later = section_places(second, next);
  for (int k = 0; k < second.layers(); ++k)
    CHECK((later[k].rotation - R * R * before[k].rotation).norm() < 1e-10);
  CHECK(next[next.size() - 1] == Approx(1.0));
}
