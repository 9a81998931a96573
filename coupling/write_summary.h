#pragma once

#include <optional>
#include <string>

#include "coupling/compare.h"
#include "coupling/confirm.h"
#include "coupling/recorder.h"
#include "coupling/scene.h"

namespace bight::coupling {

/// What came out of a run.
struct RunReport {
  const Scene& scene;
  int threads = 1;
  rod1d::RodResult rod = {};
  std::optional<solid3d::SolidResult> solid = {};
  std::vector<Confirmation> confirmed = {};
  Comparison comparison = {};

  bool interrupted() const;
  bool finished() const;        ///< everything the scene asks for is there
  std::string status() const;   ///< "finished", "gave up" or "interrupted"
  std::string verdict() const;  ///< the same with the reason, in a sentence
};

/// summary.json: versions, machine, phases, sizes, steps, worst values, what the comparison says.
void write_summary(const RunReport& report, Recorder& recorder);

}  // namespace bight::coupling
