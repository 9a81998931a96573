#include "coupling/write_vtu.h"

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <span>

#include "coupling/errors.h"
#include "coupling/files.h"
#include "coupling/frames.h"

namespace bight::coupling {
namespace {

void set_points(vtkUnstructuredGrid* grid, const std::vector<Vector3>& positions, double scale) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const Vector3& p : positions)
    points->InsertNextPoint(scale * p.x(), scale * p.y(), scale * p.z());
  grid->SetPoints(points);
}

// Fields a model did not fill in are left out.
void add_field(vtkDataSetAttributes* attributes, const char* name, std::span<const double> values,
               double scale = 1) {
  if (values.empty()) return;
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  for (const double value : values) array->InsertNextValue(scale * value);
  attributes->AddArray(array);
}

void add_field(vtkDataSetAttributes* attributes, const char* name,
               const std::vector<Vector3>& values, double scale = 1) {
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(3);
  for (const Vector3& v : values)
    array->InsertNextTuple3(scale * v.x(), scale * v.y(), scale * v.z());
  attributes->AddArray(array);
}

// Values by these numbers; none of a field that was not filled in.
std::vector<double> at(const std::vector<double>& values, const std::vector<int>& numbers) {
  std::vector<double> taken;
  if (values.empty()) return taken;
  for (const int number : numbers) taken.push_back(values[number]);
  return taken;
}

void write_grid(const std::filesystem::path& file, vtkUnstructuredGrid* grid) {
  const std::string beside = file.string() + ".part";
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetFileName(beside.c_str());
  writer->SetInputData(grid);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  if (!writer->Write()) throw FileError(beside + ": cannot be written");
  std::error_code error;
  std::filesystem::rename(beside, file, error);
  if (error)
    throw FileError(fmt::format("{}: cannot be written: {}", file.string(), error.message()));
}

}  // namespace

void write_rod_vtu(const std::filesystem::path& file, const rod1d::RodState& state,
                   const Scales& scales) {
  vtkNew<vtkUnstructuredGrid> grid;
  set_points(grid, state.nodes, scales.length());
  std::vector<vtkIdType> line(state.nodes.size());
  for (size_t i = 0; i < line.size(); ++i) line[i] = static_cast<vtkIdType>(i);
  grid->Allocate(1);
  grid->InsertNextCell(VTK_POLY_LINE, static_cast<vtkIdType>(line.size()), line.data());

  const std::vector<double> radius(state.nodes.size(), 0.5 * scales.diameter);
  const NodeFrames frames = node_frames(state);
  add_field(grid->GetPointData(), "radius", radius);
  add_field(grid->GetPointData(), "s", state.s);
  add_field(grid->GetPointData(), "curvature", state.curvature);
  add_field(grid->GetPointData(), "contact_force", state.contact_force, scales.force_per_length());
  add_field(grid->GetPointData(), "d1", frames.d1);
  add_field(grid->GetPointData(), "d2", frames.d2);
  add_field(grid->GetPointData(), "d3", frames.d3);
  write_grid(file, grid);
}

void write_solid_vtu(const std::filesystem::path& file, const solid3d::Mesh& mesh,
                     const solid3d::SolidState& state, const Scales& scales) {
  vtkNew<vtkUnstructuredGrid> grid;
  set_points(grid, state.nodes, scales.length());
  // A cell of second degree is shown as the eight hexahedra of its nodes, which every filter knows.
  std::vector<int> cells;
  const int degree = mesh.degree(), intervals = mesh.layers() - 1;
  const int quads = static_cast<int>(mesh.section.quads.size());
  grid->Allocate(static_cast<vtkIdType>(intervals) * quads);
  for (int k = 0; k < intervals; ++k)
    for (int q = 0; q < quads; ++q) {
      std::array<vtkIdType, 8> nodes;
      for (int i = 0; i < 4; ++i) {
        nodes[i] = mesh.node(k, mesh.section.quads[q][i]);
        nodes[4 + i] = mesh.node(k + 1, mesh.section.quads[q][i]);
      }
      grid->InsertNextCell(VTK_HEXAHEDRON, 8, nodes.data());
      cells.push_back(mesh.cells_before(k) + q / (degree * degree));
    }
  std::vector<Vector3> reference;
  for (int i = 0; i < mesh.nodes(); ++i) reference.push_back(mesh.reference(i));
  add_field(grid->GetPointData(), "reference", reference, scales.length());
  add_field(grid->GetPointData(), "contact_pressure", state.contact_pressure, scales.stress());
  add_field(grid->GetPointData(), "gap", state.gap, scales.length());
  add_field(grid->GetCellData(), "J", at(state.jacobian, cells));
  add_field(grid->GetCellData(), "pressure", at(state.pressure, cells), scales.stress());
  add_field(grid->GetCellData(), "von_mises", at(state.von_mises, cells), scales.stress());
  write_grid(file, grid);
}

void Series::add(double ebar, const std::string& state_file) {
  entries_ +=
      fmt::format("    <DataSet timestep=\"{:.9g}\" part=\"0\" file=\"{}\"/>\n", ebar, state_file);
  write_whole(file_,
              "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n"
              "  <Collection>\n" +
                  entries_ + "  </Collection>\n</VTKFile>\n");
}

}  // namespace bight::coupling
