#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "mechanics/types.h"

namespace bight::coupling {

/// The outside of a solid's mesh.
struct Surface {
  std::vector<Vector3> points;  ///< [m]
  std::vector<std::array<std::uint32_t, 4>> quads;
  std::map<std::string, std::vector<double>> fields;  ///< a value a point, in the unit of the file
};

/// Reads the state that write_solid_vtu wrote. Fields of cells are averaged over the surface quads
/// around a point. Throws FileError when the file cannot be read or is no such mesh.
Surface read_surface(const std::filesystem::path& vtu);

}  // namespace bight::coupling
