#include "coupling/write_csv.h"

#include <fmt/format.h>

#include <cmath>

namespace bight::coupling {

ForceCsv::ForceCsv(const std::filesystem::path& file, const Scales& scales)
    : scales_(scales),
      file_(file,
            "ebar,force_normalised,force_N,energy_J,dissipated_J,max_penetration,contact_pairs,"
            "newton_iterations,wall_s,increment,cutbacks,residual,reaction_mismatch,min_jacobian,"
            "end_turn,snapped_J,ebar_unstretched,time_s,kinetic_J,end_torque_Nm") {}

void ForceCsv::step(const StepRow& row) {
  file_.line(fmt::format(
      "{:.12g},{:.12g},{:.12g},{:.12g},{:.12g},{:.9g},{},{},{:.9g},{:.9g},{},{:.9g},{:.9g},{:.9g},"
      "{:.12g},{:.12g},{:.12g},{:.12g},{:.12g},{:.12g}",
      row.ebar, normalised_force(row.tension), row.tension * scales_.force(),
      row.energy * scales_.energy(), row.dissipated * scales_.energy(), row.max_penetration,
      row.contact_pairs, row.newton_iterations, row.wall_s, row.increment, row.cutbacks,
      row.residual, row.reaction_mismatch, row.min_jacobian, row.end_turn,
      row.snapped * scales_.energy(), row.ebar_unstretched, row.time * scales_.time(),
      row.kinetic * scales_.energy(), row.end_torque * scales_.energy()));
}

std::string state_name(double ebar) {
  const double rounded = std::round(ebar * 1000) / 1000 + 0.0;  // + 0.0: no "-000.000"
  return fmt::format("ebar_{:+08.3f}", rounded == 0 ? 0.0 : rounded);
}

void write_csv(const std::filesystem::path& file, const std::vector<Column>& columns) {
  std::string text;
  size_t rows = 0;
  for (const Column& column : columns) {
    if (column.values.empty()) continue;
    text += (text.empty() ? "" : ",") + column.name;
    rows = column.values.size();
  }
  text += '\n';
  for (size_t i = 0; i < rows; ++i) {
    std::string line;
    for (const Column& column : columns) {
      if (column.values.empty()) continue;
      if (!line.empty()) line += ',';
      line += fmt::format("{:.12g}", column.values[i]);
    }
    text += line + '\n';
  }
  write_whole(file, text);
}

void write_centerline(const std::filesystem::path& file, std::span<const double> s,
                      const Polyline& line, std::span<const double> curvature,
                      const std::vector<Column>& more) {
  std::vector<double> x, y, z;
  for (const Vector3& point : line) {
    x.push_back(point.x());
    y.push_back(point.y());
    z.push_back(point.z());
  }
  std::vector<Column> columns = {{"s", s}, {"x", x}, {"y", y}, {"z", z}, {"kappa", curvature}};
  columns.insert(columns.end(), more.begin(), more.end());
  write_csv(file, columns);
}

}  // namespace bight::coupling
