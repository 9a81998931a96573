#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "coupling/units.h"
#include "rod1d/run_rod.h"
#include "solid3d/run_solid.h"

namespace bight::coupling {

/// The rod as a polyline in metres, with the point fields radius [m], s [D], curvature [1/D],
/// contact_force [N/m] and the frame d1, d2, d3.
void write_rod_vtu(const std::filesystem::path& file, const rod1d::RodState& state,
                   const Scales& scales);

/// The deformed hexahedra in metres, with the point fields reference [m], contact_pressure [Pa],
/// gap [m] and the cell fields J, pressure [Pa] (tension positive), von_mises [Pa].
void write_solid_vtu(const std::filesystem::path& file, const solid3d::Mesh& mesh,
                     const solid3d::SolidState& state, const Scales& scales);

/// A .pvd: the series of states that ParaView opens; its time is ebar. Rewritten whole at each add.
class Series {
 public:
  explicit Series(std::filesystem::path file) : file_(std::move(file)) {}
  void add(double ebar, const std::string& state_file);  ///< relative to the .pvd

 private:
  std::filesystem::path file_;
  std::string entries_;
};

}  // namespace bight::coupling
