#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "solid3d/checkpoint.h"
#include "solid3d/run_solid.h"

namespace bight::coupling {

/// What a resumed run goes on from: the solid's model, and what it had handed out by then.
struct Checkpoint {
  solid3d::SolidCheckpoint solid;
  std::vector<StepRow> rows;                ///< all accepted steps
  std::vector<solid3d::SolidState> states;  ///< recorded ones, without their fields
};

/// Checkpoints of a results folder: HDF5 files in DIR/checkpoint, written beside and renamed, the
/// last two kept. At every instant one of them is whole.
void write_checkpoint(const std::filesystem::path& folder, const Checkpoint& checkpoint);

/// The newest that can be read; nothing where there is none.
std::optional<Checkpoint> newest_checkpoint(const std::filesystem::path& folder);

void remove_checkpoints(const std::filesystem::path& folder);

}  // namespace bight::coupling
