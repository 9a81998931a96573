#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace bight::coupling {

/// What the user asked for.
struct Command {
  std::string verb;
  std::filesystem::path scene;
  std::vector<std::filesystem::path> sources;   ///< of `compare`
  std::string only_case;                        ///< of a scene with cases; empty: all
  std::filesystem::path results;                ///< of `report`
  std::vector<std::filesystem::path> measured;  ///< of `report`, laid over the force curves
  std::filesystem::path script;                 ///< of `report`; empty: not given
  std::filesystem::path out;                    ///< empty: not given
  std::vector<std::string> settings;            ///< "key=value"
  std::vector<std::string> grid;                ///< "key=value,value" of `study`
  std::filesystem::path jobs, slurm;            ///< of `study`: written instead of running
  int threads = 1;
  bool resume = false, force = false, quiet = false;
};

/// Nothing when the words were answered here (--help, --version). Throws InputError.
std::optional<Command> read_command_line(int argc, char** argv);

}  // namespace bight::coupling
