#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <vector>

namespace bight::coupling {

/// What the files of a results folder hold, for its page, in at most about `bytes` of JSON:
///   scene       scene.toml as a table, "scene_text" as text
///   summary     summary.json; null while a run is not finished
///   force       fidelity -> the columns of force.csv
///   comparison  every force curve and the loose-knot law on one ebar axis, `measured` ones too
///   curvature   mean difference between the fidelities at each recorded ebar
///   law         the loose-knot law for a smooth line
///   states      the recorded ones, see report_states.h
///   notes       lines of run.log about cut steps and snaps
///   study       study.csv as text, study.json
/// Throws InputError when the folder holds no result, FileError when a file cannot be read.
nlohmann::ordered_json report_data(const std::filesystem::path& folder,
                                   const std::vector<std::filesystem::path>& measured,
                                   size_t bytes);

}  // namespace bight::coupling
