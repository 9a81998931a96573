#include "coupling/write_vtu.h"

#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <algorithm>
#include <catch2/catch.hpp>

#include "temporary_folder.h"

using namespace bight;
using namespace bight::coupling;

namespace {

const Scales scales{0.0083, 1.25e6};

}  // namespace

TEST_CASE("the solid reads back deformed, in metres, with its fields") {
  const TemporaryFolder folder;
  const solid3d::Mesh mesh = solid3d::make_mesh(solid3d::make_section(12), {0, 0.5, 1});
  solid3d::SolidState state;
  for (int i = 0; i < mesh.nodes(); ++i) state.nodes.push_back(2 * mesh.reference(i));
  state.jacobian.assign(mesh.cells.size(), 8.0);
  state.contact_pressure.assign(mesh.nodes(), 0.01);
  state.pressure.assign(mesh.cells.size(), -0.02);
  state.von_mises.assign(mesh.cells.size(), 0.03);
  state.gap.assign(mesh.nodes(), 0.5);
  write_solid_vtu(folder / "state.vtu", mesh, state, scales);

  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName((folder / "state.vtu").c_str());
  reader->Update();
  vtkUnstructuredGrid* grid = reader->GetOutput();
  REQUIRE(grid->GetNumberOfCells() == 24);
  CHECK(grid->GetCellType(0) == VTK_HEXAHEDRON);
  for (int i = 0; i < mesh.nodes(); ++i) {
    CHECK((Eigen::Map<const Vector3>(grid->GetPoint(i)) - 0.0166 * mesh.reference(i)).norm() <
          1e-15);
    double reference[3];
    grid->GetPointData()->GetArray("reference")->GetTuple(i, reference);
    CHECK((Eigen::Map<Vector3>(reference) - 0.0083 * mesh.reference(i)).norm() < 1e-15);
  }
  CHECK(grid->GetCellData()->GetArray("J")->GetTuple1(23) == 8.0);
  CHECK(grid->GetPointData()->GetArray("contact_pressure")->GetTuple1(0) == Approx(1.25e4));
  CHECK(grid->GetCellData()->GetArray("pressure")->GetTuple1(0) == Approx(-2.5e4));
  CHECK(grid->GetPointData()->GetArray("gap")->GetTuple1(0) == Approx(0.00415));
  CHECK(grid->GetCellData()->GetArray("von_mises")->GetTuple1(0) == Approx(3.75e4));

  state.von_mises.clear();
  write_solid_vtu(folder / "state.vtu", mesh, state, scales);
  reader->Modified();
  reader->Update();
  CHECK(reader->GetOutput()->GetCellData()->GetArray("von_mises") == nullptr);  // not filled in
}

TEST_CASE("a quadratic cell is shown as eight hexahedra with its fields") {
  const TemporaryFolder folder;
  const solid3d::Mesh mesh = solid3d::make_mesh(solid3d::make_section(5, 2), {0, 0.5, 1});
  solid3d::SolidState state;
  for (int i = 0; i < mesh.nodes(); ++i) state.nodes.push_back(mesh.reference(i));
  for (size_t c = 0; c < mesh.cells.size(); ++c) state.pressure.push_back(static_cast<double>(c));
  write_solid_vtu(folder / "state.vtu", mesh, state, scales);

  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName((folder / "state.vtu").c_str());
  reader->Update();
  vtkUnstructuredGrid* grid = reader->GetOutput();
  REQUIRE(grid->GetNumberOfCells() == 8 * 10);
  std::vector<int> shown(mesh.cells.size(), 0);
  for (vtkIdType i = 0; i < grid->GetNumberOfCells(); ++i) {
    const double pressure = grid->GetCellData()->GetArray("pressure")->GetTuple1(i);
    const auto c = static_cast<size_t>(std::lround(pressure / scales.stress()));
    ++shown[c];
    // Of its eight nodes all belong to that cell.
    for (vtkIdType a = 0; a < 8; ++a)
      CHECK(std::ranges::count(mesh.cells[c], grid->GetCell(i)->GetPointId(a)) == 1);
  }
  for (const int times : shown) CHECK(times == 8);
}

TEST_CASE("the rod reads back as one line with orthonormal frames") {
  const TemporaryFolder folder;
  rod1d::RodState state;
  for (int i = 0; i <= 40; ++i) {
    const double t = 0.2 * i;
    state.nodes.emplace_back(std::cos(t), std::sin(t), 0.3 * t);
    state.s.push_back(t);
    state.curvature.push_back(0.9);
    state.contact_force.push_back(0.1);
  }
  write_rod_vtu(folder / "state.vtu", state, scales);

  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName((folder / "state.vtu").c_str());
  reader->Update();
  vtkUnstructuredGrid* grid = reader->GetOutput();
  REQUIRE(grid->GetNumberOfCells() == 1);
  CHECK(grid->GetCell(0)->GetNumberOfPoints() == 41);
  CHECK(grid->GetPointData()->GetArray("s")->GetTuple1(40) == Approx(8));
  CHECK(grid->GetPointData()->GetArray("contact_force")->GetTuple1(7) == Approx(0.1 * 10375));
  CHECK(grid->GetPoint(0)[0] == Approx(0.0083));
  CHECK(grid->GetPointData()->GetArray("radius")->GetTuple1(7) == Approx(0.00415));
  for (int i = 0; i <= 40; ++i) {
    Matrix3 frame;
    grid->GetPointData()->GetArray("d1")->GetTuple(i, frame.col(0).data());
    grid->GetPointData()->GetArray("d2")->GetTuple(i, frame.col(1).data());
    grid->GetPointData()->GetArray("d3")->GetTuple(i, frame.col(2).data());
    CHECK((frame.transpose() * frame - Matrix3::Identity()).norm() < 1e-12);
    CHECK(frame.determinant() == Approx(1));
  }
}

TEST_CASE("a series names every state with ebar as its time") {
  const TemporaryFolder folder;
  Series series(folder / "rod.pvd");
  series.add(20, "vtu/a.vtu");
  series.add(-10.5, "vtu/b.vtu");
  const std::string text = text_of(folder / "rod.pvd");
  CHECK(text.find("timestep=\"20\" part=\"0\" file=\"vtu/a.vtu\"") != text.npos);
  CHECK(text.find("timestep=\"-10.5\" part=\"0\" file=\"vtu/b.vtu\"") != text.npos);
  CHECK(text.ends_with("</VTKFile>\n"));
}
