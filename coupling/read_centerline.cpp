#include "coupling/read_centerline.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>

#include "coupling/errors.h"
#include "coupling/read_table.h"
#include "coupling/spline.h"

namespace bight::coupling {
namespace {

constexpr size_t fewest_points = 10;

}  // namespace

Polyline read_centerline(const std::filesystem::path& file) {
  const Table table = read_table(file);
  std::array<int, 3> columns = {0, 1, 2};
  if (!table.names.empty()) columns = {table.column("x"), table.column("y"), table.column("z")};

  Polyline line;
  for (size_t i = 0; i < table.rows.size(); ++i) {
    const std::vector<double>& row = table.rows[i];
    const auto place = [&] { return fmt::format("{}:{}", file.string(), table.lines[i]); };
    if (row.size() < 3) throw InputError(place() + ": a point needs x, y and z");
    const Vector3 point(row[columns[0]], row[columns[1]], row[columns[2]]);
    if (line.empty() || point != line.back()) line.push_back(point);
  }
  if (line.size() < fewest_points)
    throw InputError(fmt::format("{}: {} different points; a knot needs at least {}", file.string(),
                                 line.size(), fewest_points));
  if ((line.back() - line.front()).norm() < 1e-3 * arc_length(line))
    throw InputError(file.string() + ": the curve is closed; its ends must lie apart to be pulled");
  return line;
}

double arc_length(const Polyline& line) {
  double length = 0;
  for (size_t i = 1; i < line.size(); ++i) length += (line[i] - line[i - 1]).norm();
  return length;
}

Polyline evenly_spaced(const Polyline& line, double shortest, int parts) {
  Polyline points{line.front()};
  std::vector<double> s{0};
  const auto add = [&](const Vector3& point) {
    s.push_back(s.back() + (point - points.back()).norm());
    points.push_back(point);
  };
  for (size_t i = 1; i + 1 < line.size(); ++i)
    if ((line[i] - points.back()).norm() >= shortest && (line[i] - line.back()).norm() >= shortest)
      add(line[i]);
  add(line.back());
  const Spline curve(s, points);
  Polyline even;
  for (int i = 0; i <= parts; ++i) even.push_back(curve.at(s.back() * i / parts).r);
  return even;
}

void align_with_z(Polyline& line) {
  const Vector3 origin = line.front();
  const auto turn = Eigen::Quaterniond::FromTwoVectors(line.back() - origin, Vector3::UnitZ());
  for (Vector3& point : line) point = turn * (point - origin);
}

}  // namespace bight::coupling
