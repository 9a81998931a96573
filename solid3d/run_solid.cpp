#include "solid3d/run_solid.h"

#include <cmath>
#include <functional>
#include <memory>

#include "solid3d/checkpoint.h"
#include "solid3d/solid_model.h"

namespace bight::solid3d {

namespace {

/// The model that follow() sees. At every checkpoint it is built anew from what is saved, so that
/// nothing that a resumed run would not have (lists of contact pairs, patterns, orderings) decides
/// about the last digits of the steps to come.
class RenewedPath final : public PathModel {
 public:
  using Build = std::function<std::unique_ptr<SolidModel>()>;
  explicit RenewedPath(Build build) : build_(std::move(build)), model_(build_()) {}

  Vector predict(double ebar) const override { return model_->predict(ebar); }
  NewtonResult solve(const Vector& guess, double ebar) override {
    return model_->solve(guess, ebar);
  }
  StepRow accept(const NewtonResult& result, double ebar) override {
    return model_->accept(result, ebar);
  }

  SolidModel& model() { return *model_; }
  void renew(const SolidCheckpoint& from) {
    for (const auto& [phase, time] : model_->seconds()) seconds_[phase] += time;
    for (const auto& [effect, time] : model_->seconds_by_effect())
      seconds_by_effect_[effect] += time;
    model_ = build_();
    model_->restore(from);
  }
  std::map<std::string, double> seconds() const {
    std::map<std::string, double> sum = seconds_;
    for (const auto& [phase, time] : model_->seconds()) sum[phase] += time;
    return sum;
  }
  std::vector<EffectCost> costs() const { return model_->costs(seconds_by_effect_); }

 private:
  Build build_;
  std::unique_ptr<SolidModel> model_;
  std::map<std::string, double> seconds_, seconds_by_effect_;  ///< of models that were replaced
};

}  // namespace

SolidResult run_solid(const Mesh& mesh, const std::vector<Vector3>& start, double start_ebar,
                      const SolidParameters& parameters, const SolidObserver& observer,
                      const SolidCheckpoint* from) {
  SolidResult result;
  const std::chrono::duration<double> before(from ? from->wall_s : 0);
  const auto began =
      SolidModel::Clock::now() - std::chrono::duration_cast<SolidModel::Clock::duration>(before);
  RenewedPath path_model([&] {
    auto model = std::make_unique<SolidModel>(mesh, start, start_ebar, parameters, began);
    model->observe(observer.on_iteration);
    return model;
  });
  if (from) path_model.model().restore(*from);
  result.unknowns = path_model.model().unknowns();
  result.cells = static_cast<int>(mesh.cells.size());
  result.symmetric = path_model.model().symmetric();
  for (const auto& effect : path_model.model().effects())
    result.effects.emplace_back(effect->name());
  if (parameters.inertia) result.effects.emplace_back("inertia");
  if (parameters.damping > 0) result.effects.emplace_back("damping");

  Path path = parameters.path;
  if (std::abs(path.waypoints.front() - start_ebar) > 1e-9)
    path.waypoints.insert(path.waypoints.begin(), start_ebar);
  PathObserver on_path;
  on_path.on_step = [&](const StepRow& row) {
    result.steps.push_back(row);
    observer.on_step(row);
  };
  on_path.on_record = [&](double ebar) {
    result.recorded.push_back(ebar);
    observer.on_record(path_model.model().state(ebar));
  };
  on_path.on_progress = [&](const PathProgress& progress) {
    // The first as early as can be: relaxing the start is long.
    if (parameters.checkpoint_every == 0 || progress.so_far.steps < 2 ||
        (progress.so_far.steps - 2) % parameters.checkpoint_every != 0 ||
        !path_model.model().can_be_saved())
      return;
    SolidCheckpoint at = path_model.model().saved();
    at.progress = progress;
    observer.on_checkpoint(at);
    path_model.renew(at);
  };
  on_path.interrupted = observer.interrupted;
  result.outcome = follow(path, path_model, on_path, from ? from->progress : PathProgress{});
  result.seconds = path_model.seconds();
  result.costs = path_model.costs();
  return result;
}

}  // namespace bight::solid3d
