#include "coupling/checkpoint.h"

#include <catch2/catch.hpp>
#include <fstream>

#include "temporary_folder.h"

using namespace bight;
using namespace bight::coupling;

namespace {

Checkpoint example(int steps) {
  Checkpoint at;
  at.solid.progress = {2, 17.123456789012345, 0.25, {}};
  at.solid.progress.so_far.steps = steps;
  at.solid.history = {{17.5, Vector::Random(30)}, {17.123456789012345, Vector::Random(30)}};
  at.solid.tension = 1.0 / 3;
  at.solid.contact_stiffness = 61.7;
  at.solid.energy = 1.0 / 7;
  at.solid.wall_s = 12.5;
  at.solid.friction.elastic_slip = {{3, Vector2(0.001, -1e-17)}, {8, Vector2(1.0 / 7, 0)}};
  at.solid.friction.dissipated = 0.1;
  at.solid.whole_friction.dissipated = 0.2;
  at.solid.motion = {1e4 / 3, Vector::Random(30), Vector::Random(30), 0.7, 1e-9 / 3};
  StepRow row;
  row.ebar = 17.5, row.tension = 0.1 + 0.2, row.cut_reason = "friction does not settle";
  at.rows = {row};
  solid3d::SolidState state;
  state.ebar = 17.5, state.curvature = {0.1, 0.2}, state.energy_by_effect = {{"strain", 1e-300}};
  at.states = {state, state};
  at.states[1].nodes = {{0.1, 1.0 / 3, -1e-20}, {1, 2, 3}};
  at.states[1].rubs = {{0.3, 17, {1e-3, 0, -1.0 / 7}}, {5, 6, {0, 1, 2}}};
  at.states[1].centerline = {{0, 0, 1.0 / 7}};
  return at;
}

}  // namespace

TEST_CASE("a checkpoint reads back exactly") {
  const TemporaryFolder folder;
  CHECK_FALSE(newest_checkpoint(folder.path()));
  const Checkpoint at = example(12);
  write_checkpoint(folder.path(), at);
  const auto back = newest_checkpoint(folder.path());
  REQUIRE(back);
  CHECK(back->solid.progress.leg == 2);
  CHECK(back->solid.progress.ebar == at.solid.progress.ebar);
  CHECK(back->solid.progress.step == 0.25);
  CHECK(back->solid.progress.so_far.steps == 12);
  REQUIRE(back->solid.history.size() == 2);
  for (const size_t k : {0, 1}) {
    CHECK(back->solid.history[k].ebar == at.solid.history[k].ebar);
    CHECK(back->solid.history[k].x == at.solid.history[k].x);
  }
  CHECK(back->solid.tension == at.solid.tension);
  CHECK(back->solid.contact_stiffness == 61.7);
  CHECK(back->solid.energy == at.solid.energy);
  CHECK(back->solid.wall_s == 12.5);
  CHECK(back->solid.friction.elastic_slip == at.solid.friction.elastic_slip);
  CHECK(back->solid.friction.dissipated == 0.1);
  CHECK(back->solid.whole_friction.dissipated == 0.2);
  REQUIRE(back->solid.motion);
  CHECK(back->solid.motion->time == at.solid.motion->time);
  CHECK(back->solid.motion->x == at.solid.motion->x);
  CHECK(back->solid.motion->v == at.solid.motion->v);
  CHECK(back->solid.motion->next_step == 0.7);
  CHECK(back->solid.motion->dissipated == at.solid.motion->dissipated);
  REQUIRE(back->rows.size() == 1);
  CHECK(back->rows[0].tension == 0.1 + 0.2);
  CHECK(back->rows[0].cut_reason == "friction does not settle");
  REQUIRE(back->states.size() == 2);
  CHECK(back->states[0].nodes.empty());
  CHECK(back->states[1].nodes == at.states[1].nodes);
  REQUIRE(back->states[1].rubs.size() == 2);
  CHECK(back->states[1].rubs[0].s_b == 17);
  CHECK(back->states[1].rubs[0].elastic_slip == at.states[1].rubs[0].elastic_slip);
  CHECK(back->states[1].centerline == at.states[1].centerline);
  CHECK(back->states[0].curvature == std::vector<double>{0.1, 0.2});
  CHECK(back->states[0].energy_by_effect.at("strain") == 1e-300);
}

TEST_CASE("the last two checkpoints are kept, and a damaged one is passed over") {
  const TemporaryFolder folder;
  for (const int steps : {4, 8, 12}) write_checkpoint(folder.path(), example(steps));
  const auto file = [&](const char* name) { return folder / "checkpoint" / name; };
  CHECK_FALSE(std::filesystem::exists(file("solid_000004.h5")));
  CHECK(std::filesystem::exists(file("solid_000008.h5")));
  CHECK(newest_checkpoint(folder.path())->solid.progress.so_far.steps == 12);
  const auto size = std::filesystem::file_size(file("solid_000012.h5"));
  std::filesystem::resize_file(file("solid_000012.h5"), size / 2);
  CHECK(newest_checkpoint(folder.path())->solid.progress.so_far.steps == 8);
  std::ofstream(file("solid_000008.h5")) << "no HDF5";
  CHECK_FALSE(newest_checkpoint(folder.path()));
  remove_checkpoints(folder.path());
  CHECK_FALSE(std::filesystem::exists(folder / "checkpoint"));
}
