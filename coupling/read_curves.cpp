#include "coupling/read_curves.h"

#include <toml++/toml.h>

#include <nlohmann/json.hpp>

#include "coupling/errors.h"
#include "coupling/files.h"
#include "coupling/read_measured.h"

namespace bight::coupling {
namespace {

namespace fs = std::filesystem;

std::string folder_name(const fs::path& folder) {
  const fs::path whole = fs::absolute(folder).lexically_normal();
  return (whole.has_filename() ? whole : whole.parent_path()).filename().string();
}

}  // namespace

std::vector<ForceCurve> read_curves(const fs::path& source, const std::optional<Scales>& scales) {
  if (!fs::exists(source)) throw InputError(source.string() + ": there is no such file or folder");
  if (!fs::is_directory(source)) return {read_measured(source, scales)};
  std::vector<ForceCurve> curves;
  for (const auto& [name, folder] : fidelity_folders(source)) {
    curves.push_back(read_measured(folder / "force.csv", scales));
    curves.back().name = name;
  }
  if (curves.empty())
    throw InputError(source.string() + ": no rod/force.csv and no solid/force.csv");
  return curves;
}

std::vector<std::pair<std::string, fs::path>> fidelity_folders(const fs::path& source) {
  std::vector<std::pair<std::string, fs::path>> folders;
  for (const char* fidelity : {"rod", "solid"})
    if (fs::exists(source / fidelity / "force.csv"))
      folders.emplace_back(folder_name(source) + "_" + fidelity, source / fidelity);
  return folders;
}

std::optional<Scales> read_scales(const fs::path& source) {
  if (!fs::is_regular_file(source / "scene.toml")) return std::nullopt;
  toml::table scene;
  try {
    scene = toml::parse(read_whole(source / "scene.toml"));
  } catch (const toml::parse_error&) {
    return std::nullopt;
  }
  const auto diameter = scene.at_path("rod.diameter").value<double>();
  const auto youngs_modulus = scene.at_path("material.youngs_modulus").value<double>();
  if (!diameter || !youngs_modulus) return std::nullopt;
  return Scales{*diameter, *youngs_modulus};
}

std::optional<double> read_friction(const fs::path& source) {
  if (!fs::is_regular_file(source / "summary.json")) return std::nullopt;
  const auto summary = nlohmann::json::parse(read_whole(source / "summary.json"), nullptr, false);
  if (!summary.is_object() || !summary.contains("friction")) return std::nullopt;
  return summary["friction"].get<double>();
}

}  // namespace bight::coupling
