#include "coupling/checkpoint.h"

#include <fmt/format.h>
#include <hdf5.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "coupling/errors.h"
#include "coupling/files.h"

namespace bight {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(StepRow, ebar, tension, energy, dissipated, max_penetration,
                                   contact_pairs, newton_iterations, wall_s, increment, cutbacks,
                                   cut_reason, residual, reaction_mismatch, min_jacobian, end_turn,
                                   end_torque, snapped, time, kinetic, flattening, ebar_unstretched)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(PathOutcome, reason, steps, iterations, factorisations, cutbacks)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(PathProgress, leg, ebar, step, so_far)

namespace solid3d {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(SolidState, ebar, s, curvature, flattening, tension,
                                   min_jacobian, determinant, skin_crossings, energy_by_effect)

}  // namespace solid3d

namespace coupling {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr size_t kept = 2;

/// An HDF5 handle that closes itself; opening it failed if it is negative.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {
    if (id_ < 0) throw FileError("HDF5 error");
  }
  ~Handle() { close_(id_); }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

void check(herr_t status) {
  if (status < 0) throw FileError("HDF5 error");
}

void write_numbers(hid_t file, const char* name, hid_t type, const void* values, hsize_t count) {
  const Handle space(H5Screate_simple(1, &count, nullptr), H5Sclose);
  const Handle set(H5Dcreate2(file, name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                   H5Dclose);
  if (count > 0) check(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values));
}

void write_vector(hid_t file, const char* name, const Vector& values) {
  write_numbers(file, name, H5T_NATIVE_DOUBLE, values.data(), static_cast<hsize_t>(values.size()));
}

template <class Values>
Values read_numbers(hid_t file, const char* name, hid_t type) {
  const Handle set(H5Dopen2(file, name, H5P_DEFAULT), H5Dclose);
  const Handle space(H5Dget_space(set), H5Sclose);
  Values values(static_cast<size_t>(H5Sget_simple_extent_npoints(space)), 0);
  if (!values.empty()) check(H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()));
  return values;
}

Vector read_vector(hid_t file, const char* name) {
  const auto values = read_numbers<std::vector<double>>(file, name, H5T_NATIVE_DOUBLE);
  return Vector::Map(values.data(), static_cast<Eigen::Index>(values.size()));
}

void write_text(hid_t file, const char* name, const std::string& text) {
  write_numbers(file, name, H5T_NATIVE_CHAR, text.data(), text.size());
}

std::string read_text(hid_t file, const char* name) {
  return read_numbers<std::string>(file, name, H5T_NATIVE_CHAR);
}

void write_memory(hid_t file, const std::string& name, const solid3d::FrictionMemory& memory) {
  std::vector<int> samples;
  Vector slips(2 * static_cast<Eigen::Index>(memory.elastic_slip.size()));
  for (const auto& [sample, slip] : memory.elastic_slip) {
    slips.segment<2>(2 * static_cast<Eigen::Index>(samples.size())) = slip;
    samples.push_back(sample);
  }
  write_numbers(file, (name + "_samples").c_str(), H5T_NATIVE_INT, samples.data(), samples.size());
  write_vector(file, (name + "_slips").c_str(), slips);
  write_vector(file, (name + "_dissipated").c_str(), Vector::Constant(1, memory.dissipated));
}

solid3d::FrictionMemory read_memory(hid_t file, const std::string& name) {
  solid3d::FrictionMemory memory;
  const auto samples =
      read_numbers<std::vector<int>>(file, (name + "_samples").c_str(), H5T_NATIVE_INT);
  const Vector slips = read_vector(file, (name + "_slips").c_str());
  for (size_t i = 0; i < samples.size(); ++i)
    memory.elastic_slip[samples[i]] = slips.segment<2>(2 * static_cast<Eigen::Index>(i));
  memory.dissipated = read_vector(file, (name + "_dissipated").c_str())[0];
  return memory;
}

constexpr Eigen::Index rub_numbers = 5;

// Points of a recorded state that is to be confirmed, and how it rubs.
void write_points(hid_t file, size_t k, const solid3d::SolidState& state) {
  for (const auto& [name, points] :
       {std::pair("nodes", &state.nodes), std::pair("centerline", &state.centerline)}) {
    Vector x(3 * static_cast<Eigen::Index>(points->size()));
    for (size_t i = 0; i < points->size(); ++i)
      x.segment<3>(3 * static_cast<Eigen::Index>(i)) = (*points)[i];
    write_vector(file, fmt::format("{}_{}", name, k).c_str(), x);
  }
  Vector rubs(rub_numbers * static_cast<Eigen::Index>(state.rubs.size()));
  Eigen::Index at = 0;
  for (const Rub& rub : state.rubs) {
    rubs.segment<rub_numbers>(at) << rub.s_a, rub.s_b, rub.elastic_slip;
    at += rub_numbers;
  }
  write_vector(file, fmt::format("rubs_{}", k).c_str(), rubs);
}

void read_points(hid_t file, size_t k, solid3d::SolidState& state) {
  for (const auto& [name, points] :
       {std::pair("nodes", &state.nodes), std::pair("centerline", &state.centerline)}) {
    const std::string set = fmt::format("{}_{}", name, k);
    if (H5Lexists(file, set.c_str(), H5P_DEFAULT) <= 0) return;
    const Vector x = read_vector(file, set.c_str());
    for (Eigen::Index i = 0; i + 2 < x.size(); i += 3) points->push_back(x.segment<3>(i));
  }
  const Vector rubs = read_vector(file, fmt::format("rubs_{}", k).c_str());
  for (Eigen::Index i = 0; i < rubs.size(); i += rub_numbers)
    state.rubs.push_back({rubs[i], rubs[i + 1], rubs.segment<3>(i + 2)});
}

void write_motion(hid_t file, const solid3d::MotionState& motion) {
  write_vector(file, "positions", motion.x);
  write_vector(file, "velocities", motion.v);
  write_vector(file, "motion", Vector3(motion.time, motion.next_step, motion.dissipated));
}

std::optional<solid3d::MotionState> read_motion(hid_t file) {
  if (H5Lexists(file, "motion", H5P_DEFAULT) <= 0) return std::nullopt;
  const Vector scalars = read_vector(file, "motion");
  return solid3d::MotionState{.time = scalars[0],
                              .x = read_vector(file, "positions"),
                              .v = read_vector(file, "velocities"),
                              .next_step = scalars[1],
                              .dissipated = scalars[2]};
}

void write_file(const fs::path& path, const Checkpoint& checkpoint) {
  const Handle file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose);
  const solid3d::SolidCheckpoint& solid = checkpoint.solid;
  Vector ebar(static_cast<Eigen::Index>(solid.history.size()));
  for (size_t k = 0; k < solid.history.size(); ++k) {
    ebar[static_cast<Eigen::Index>(k)] = solid.history[k].ebar;
    write_vector(file, fmt::format("state_{}", k).c_str(), solid.history[k].x);
  }
  write_vector(file, "ebar", ebar);
  for (size_t k = 0; k < checkpoint.states.size(); ++k)
    if (!checkpoint.states[k].nodes.empty()) write_points(file, k, checkpoint.states[k]);
  write_vector(file, "scales",
               Eigen::Vector4d(solid.tension, solid.contact_stiffness, solid.wall_s, solid.energy));
  write_memory(file, "friction", solid.friction);
  write_memory(file, "whole_friction", solid.whole_friction);
  if (solid.motion) write_motion(file, *solid.motion);
  // Numbers in JSON are written so that they read back exactly.
  const Json log = {
      {"progress", solid.progress}, {"rows", checkpoint.rows}, {"states", checkpoint.states}};
  write_text(file, "log", log.dump());
  check(H5Fflush(file, H5F_SCOPE_GLOBAL));
}

Checkpoint read_file(const fs::path& path) {
  const Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  Checkpoint checkpoint;
  solid3d::SolidCheckpoint& solid = checkpoint.solid;
  const Vector ebar = read_vector(file, "ebar");
  for (Eigen::Index k = 0; k < ebar.size(); ++k)
    solid.history.push_back({ebar[k], read_vector(file, fmt::format("state_{}", k).c_str())});
  const Vector scales = read_vector(file, "scales");
  if (scales.size() != 4) throw std::runtime_error(path.string() + ": of another version");
  solid.tension = scales[0], solid.contact_stiffness = scales[1], solid.wall_s = scales[2];
  solid.energy = scales[3];
  solid.friction = read_memory(file, "friction");
  solid.whole_friction = read_memory(file, "whole_friction");
  solid.motion = read_motion(file);
  const Json log = Json::parse(read_text(file, "log"));
  log.at("progress").get_to(solid.progress);
  log.at("rows").get_to(checkpoint.rows);
  log.at("states").get_to(checkpoint.states);
  for (size_t k = 0; k < checkpoint.states.size(); ++k) read_points(file, k, checkpoint.states[k]);
  return checkpoint;
}

/// Names sort by the number of steps.
std::vector<fs::path> files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  if (!fs::is_directory(folder / "checkpoint")) return files;
  for (const auto& entry : fs::directory_iterator(folder / "checkpoint"))
    if (entry.path().extension() == ".h5") files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

}  // namespace

void write_checkpoint(const fs::path& folder, const Checkpoint& checkpoint) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  make_folder(folder / "checkpoint");
  const fs::path file =
      folder / "checkpoint" / fmt::format("solid_{:06}.h5", checkpoint.solid.progress.so_far.steps);
  const fs::path beside = file.string() + ".part";
  try {
    write_file(beside, checkpoint);
    fs::rename(beside, file);
  } catch (const FileError&) {
    throw FileError(fmt::format("{}: a checkpoint cannot be written", file.string()));
  } catch (const fs::filesystem_error& error) {
    throw FileError(fmt::format("{}: cannot be written: {}", file.string(), error.what()));
  }
  std::vector<fs::path> files = files_in(folder);
  for (size_t i = 0; i + kept < files.size(); ++i) fs::remove(files[i]);
}

std::optional<Checkpoint> newest_checkpoint(const fs::path& folder) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  std::vector<fs::path> files = files_in(folder);
  for (; !files.empty(); files.pop_back()) try {
      return read_file(files.back());
    } catch (const FileError&) {  // not whole: the one before is
    } catch (const Json::exception&) {
    }
  return std::nullopt;
}

void remove_checkpoints(const fs::path& folder) { fs::remove_all(folder / "checkpoint"); }

}  // namespace coupling
}  // namespace bight
