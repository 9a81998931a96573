#include "coupling/read_surface.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDataSetSurfaceFilter.h>
#include <vtkErrorCode.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkObject.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include "coupling/errors.h"

namespace bight::coupling {
namespace {

// Names and values of the arrays with one number an entry.
std::map<std::string, std::vector<double>> scalars(vtkDataSetAttributes* attributes) {
  std::map<std::string, std::vector<double>> result;
  for (int k = 0; k < attributes->GetNumberOfArrays(); ++k) {
    vtkDataArray* array = attributes->GetArray(k);
    if (!array || array->GetNumberOfComponents() != 1) continue;
    std::vector<double>& values = result[array->GetName()];
    for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
      values.push_back(array->GetTuple1(i));
  }
  return result;
}

std::vector<double> averaged(const Surface& surface, const std::vector<double>& of_quads) {
  std::vector<double> sum(surface.points.size(), 0.0), count(surface.points.size(), 0.0);
  for (size_t q = 0; q < surface.quads.size(); ++q)
    for (const std::uint32_t point : surface.quads[q]) {
      sum[point] += of_quads[q];
      count[point] += 1;
    }
  for (size_t i = 0; i < sum.size(); ++i) sum[i] /= std::max(1.0, count[i]);
  return sum;
}

}  // namespace

Surface read_surface(const std::filesystem::path& vtu) {
  vtkObject::GlobalWarningDisplayOff();  // what is wrong is said below
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(vtu.c_str());
  reader->Update();
  if (reader->GetErrorCode() != vtkErrorCode::NoError ||
      reader->GetOutput()->GetNumberOfCells() == 0)
    throw FileError(vtu.string() + ": cannot be read as a mesh (VTU)");
  vtkNew<vtkDataSetSurfaceFilter> filter;
  filter->SetInputData(reader->GetOutput());
  filter->Update();
  vtkPolyData* outside = filter->GetOutput();

  Surface surface;
  for (vtkIdType i = 0; i < outside->GetNumberOfPoints(); ++i)
    surface.points.push_back(Eigen::Map<const Vector3>(outside->GetPoint(i)));
  vtkNew<vtkIdList> corners;
  for (vtkIdType q = 0; q < outside->GetNumberOfCells(); ++q) {
    outside->GetCellPoints(q, corners);
    if (corners->GetNumberOfIds() != 4)
      throw FileError(vtu.string() + ": its surface is not made of quadrilaterals");
    auto& quad = surface.quads.emplace_back();
    for (int k = 0; k < 4; ++k) quad[k] = static_cast<std::uint32_t>(corners->GetId(k));
  }
  surface.fields = scalars(outside->GetPointData());
  for (const auto& [name, values] : scalars(outside->GetCellData()))
    surface.fields[name] = averaged(surface, values);
  return surface;
}

}  // namespace bight::coupling
