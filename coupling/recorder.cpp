#include "coupling/recorder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "coupling/interrupt.h"

namespace bight::coupling {

namespace {

/// M D/B of a moment in E D^3, B = pi E D^4/64: the kappa D of a linear rod.
constexpr double normalised_moment = 64 / std::numbers::pi;

std::vector<double> times(std::vector<double> values, double factor) {
  for (double& value : values) value *= factor;
  return values;
}

}  // namespace

Recorder::Files::Files(const std::filesystem::path& in, const std::string& name,
                       const Scales& scales)
    : folder((make_folder(in / name / "centerline"), make_folder(in / name / "vtu"), in / name)),
      force(folder / "force.csv", scales),
      series(folder / (name + ".pvd")) {}

std::string Recorder::Files::next_name(double ebar) {
  const std::string name = state_name(ebar);
  const int times = ++met[name];
  return times == 1 ? name : fmt::format("{}_{}", name, times);
}

Recorder::Recorder(const std::filesystem::path& folder, const Scene& scene, bool quiet)
    : progress((make_folder(folder), folder / "run.log"), quiet), folder_(folder), scene_(scene) {
  write_whole(folder / "scene.toml", scene.text);
  for (const std::string& warning : scene.warnings) progress.say("warning: " + warning);
}

rod1d::RodObserver Recorder::watch_rod(const Path& path) {
  if (scene_.rod) rod_.emplace(folder_, "rod", scene_.scales());
  if (scene_.rod && scene_.contact) make_folder(folder_ / "rod" / "contacts");
  progress.begin("rod", path);
  phases.enter("tie");
  rod1d::RodObserver observer;
  if (scene_.rod && scene_.from_straight) {
    make_folder(rod_->folder / "tie");
    observer.on_tie = [this, count = 0, series = Series(rod_->folder / "tie.pvd")](
                          const rod1d::RodState& state) mutable {
      const std::string name = fmt::format("tie/tie_{:03}.vtu", count);
      write_rod_vtu(rod_->folder / name, state, scene_.scales());
      series.add(count++, name);
    };
  }
  observer.on_step = [this](const StepRow& row) {
    phases.enter("write");
    progress.step(row);
    if (rod_) rod_->force.step(row);
    phases.enter("rod");
  };
  observer.on_record = [this](const rod1d::RodState& state) {
    phases.enter("write");
    if (!seed && std::abs(state.ebar - scene_.seed_ebar) < 1e-6) seed = state;
    if (rod_) write(state);
    phases.enter("rod");
  };
  observer.interrupted = interrupted;
  return observer;
}

solid3d::SolidObserver Recorder::watch_solid(const solid3d::Mesh& mesh, const Path& path,
                                             const std::optional<Checkpoint>& from) {
  solid_.emplace(folder_, "solid", scene_.scales());
  progress.begin("solid", path);
  phases.enter("seed");
  const auto write_row = [this](const StepRow& row) {
    progress.step(row);
    solid_->force.step(row);
    solid_rows.push_back(row);
  };
  if (from) {
    for (const StepRow& row : from->rows) write_row(row);
    solid_states = from->states;
    for (const solid3d::SolidState& state : solid_states)
      solid_->series.add(state.ebar, "vtu/" + solid_->next_name(state.ebar) + ".vtu");
    progress.say(fmt::format("resumed at ebar {:.6g}", from->solid.progress.ebar));
  }
  solid3d::SolidObserver observer;
  observer.on_step = [this, write_row](const StepRow& row) {
    phases.enter("write");
    write_row(row);
    phases.enter("tighten");
  };
  observer.on_checkpoint = [this](const solid3d::SolidCheckpoint& at) {
    phases.enter("write");
    write_checkpoint(folder_, {at, solid_rows, solid_states});
    phases.enter("tighten");
  };
  observer.on_record = [this, &mesh](const solid3d::SolidState& state) {
    phases.enter("write");
    write(*solid_, mesh, state);
    keep(state);
    phases.enter("tighten");
  };
  observer.interrupted = interrupted;
  return observer;
}

solid3d::SolidObserver Recorder::watch_confirmation(const solid3d::Mesh& mesh, const Path& path) {
  if (!confirmed_) confirmed_.emplace(folder_, "confirm", scene_.scales());
  progress.begin("confirm", path);
  phases.enter("confirm");
  solid3d::SolidObserver observer;
  observer.on_step = [this](const StepRow& row) {
    progress.step(row);
    confirmed_->force.step(row);
  };
  observer.on_record = [this, &mesh](const solid3d::SolidState& state) {
    phases.enter("write");
    write(*confirmed_, mesh, state);
    phases.enter("confirm");
  };
  observer.interrupted = interrupted;
  return observer;
}

void Recorder::write(const rod1d::RodState& state) {
  const std::string name = rod_->next_name(state.ebar);
  write_centerline(rod_->folder / "centerline" / (name + ".csv"), state.s, state.nodes,
                   state.curvature,
                   {{"contact_force", state.contact_force}, {"twist", state.twist}});
  if (!state.contacts.empty()) {
    std::vector<double> a, b, force;
    for (const rod1d::ContactSpot& at : state.contacts) {
      a.push_back(at.s_a), b.push_back(at.s_b);
      force.push_back(normalised_force(at.force));
    }
    write_csv(rod_->folder / "contacts" / (name + ".csv"),
              {{"s_a", a}, {"s_b", b}, {"force_normalised", force}});
  }
  write_rod_vtu(rod_->folder / "vtu" / (name + ".vtu"), state, scene_.scales());
  rod_->series.add(state.ebar, "vtu/" + name + ".vtu");
}

void Recorder::write(Files& files, const solid3d::Mesh& mesh, const solid3d::SolidState& state) {
  const std::string name = files.next_name(state.ebar);
  write_centerline(files.folder / "centerline" / (name + ".csv"), state.s, state.centerline,
                   state.curvature,
                   {{"flattening", state.flattening},
                    {"axial_force", times(state.loads.axial, normalised_force(1))},
                    {"bending_moment", times(state.loads.bending, normalised_moment)},
                    {"twisting_moment", times(state.loads.twisting, normalised_moment)}});
  write_solid_vtu(files.folder / "vtu" / (name + ".vtu"), mesh, state, scene_.scales());
  if (state.skin_crossings > 0)
    progress.say(fmt::format("the surface cuts itself at ebar {:.6g}: {} pairs of triangles",
                             state.ebar, state.skin_crossings));
  files.series.add(state.ebar, "vtu/" + name + ".vtu");
}

void Recorder::keep(const solid3d::SolidState& state) {
  solid3d::SolidState light = state;
  for (auto* field :
       {&light.jacobian, &light.pressure, &light.von_mises, &light.contact_pressure, &light.gap})
    field->clear();
  const auto same = [&](double ebar) { return std::abs(ebar - state.ebar) < 1e-6; };
  if (std::ranges::none_of(scene_.confirm_at, same))
    light.nodes.clear(), light.centerline.clear(), light.rubs.clear();
  solid_states.push_back(std::move(light));
}

}  // namespace bight::coupling
