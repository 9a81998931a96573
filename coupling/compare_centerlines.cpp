#include "coupling/compare_centerlines.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "coupling/read_table.h"
#include "coupling/write_csv.h"

namespace bight::coupling {
namespace {

namespace fs = std::filesystem;

struct Profile {
  std::vector<double> s, kappa;

  double at(double where) const {
    const auto after = std::ranges::lower_bound(s, where);
    if (after == s.begin() || after == s.end()) return 0;
    const size_t i = static_cast<size_t>(after - s.begin());
    const double t = (where - s[i - 1]) / (s[i] - s[i - 1]);
    return (1 - t) * kappa[i - 1] + t * kappa[i];
  }

  // Mean of s weighted by kappa^2, the bending energy.
  double middle() const {
    double weight = 0, moment = 0;
    for (size_t i = 0; i + 1 < s.size(); ++i) {
      const double k = 0.5 * (kappa[i] + kappa[i + 1]), energy = k * k * (s[i + 1] - s[i]);
      weight += energy;
      moment += energy * 0.5 * (s[i] + s[i + 1]);
    }
    return weight > 0 ? moment / weight : 0;
  }
};

Profile read_profile(const fs::path& file) {
  const Table table = read_table(file);
  const int s = table.column("s"), kappa = table.column("kappa");
  Profile profile;
  for (const auto& row : table.rows) {
    profile.s.push_back(row[s]);
    profile.kappa.push_back(row[kappa]);
  }
  return profile;
}

CurvatureDifference difference(const Profile& a, const Profile& b) {
  constexpr double spacing = 0.05;  // [D]
  CurvatureDifference result;
  result.largest_a = std::ranges::max(a.kappa);
  result.largest_b = std::ranges::max(b.kappa);
  const double shift = b.middle() - a.middle();
  double apart = 0, whole = 0;
  for (double s = a.s.front(); s <= a.s.back(); s += spacing) {
    const double kappa = a.at(s);
    if (kappa < 0.1 * result.largest_a) continue;
    apart += std::abs(b.at(s + shift) - kappa);
    whole += kappa;
  }
  result.mean = whole > 0 ? apart / whole : 0;
  return result;
}

}  // namespace

std::vector<CurvatureDifference> compare_centerlines(const fs::path& a, const fs::path& b) {
  std::vector<CurvatureDifference> result;
  if (!fs::is_directory(a / "centerline")) return result;
  for (const auto& entry : fs::directory_iterator(a / "centerline")) {
    const fs::path twin = b / "centerline" / entry.path().filename();
    if (entry.path().extension() != ".csv" || !fs::exists(twin)) continue;
    result.push_back(difference(read_profile(entry.path()), read_profile(twin)));
    result.back().state = entry.path().stem().string();
    result.back().ebar = std::stod(result.back().state.substr(5));
  }
  std::ranges::sort(result, std::greater{}, &CurvatureDifference::ebar);
  return result;
}

std::string curvature_text(const std::string& a, const std::string& b,
                           const std::vector<CurvatureDifference>& differences) {
  std::string text;
  for (const CurvatureDifference& d : differences)
    text += fmt::format("{} {:.1f} % at ebar {:g}", text.empty() ? "" : ",", 100 * d.mean, d.ebar);
  return text.empty()
             ? text
             : fmt::format("curvature of {} is off that of {} on average by{}\n", b, a, text);
}

void write_curvature(const fs::path& file, const std::vector<CurvatureDifference>& differences) {
  std::vector<double> ebar, mean, a, b;
  for (const CurvatureDifference& d : differences) {
    ebar.push_back(d.ebar);
    mean.push_back(d.mean);
    a.push_back(d.largest_a);
    b.push_back(d.largest_b);
  }
  write_csv(
      file,
      {{"ebar", ebar}, {"mean_difference", mean}, {"largest_kappa_a", a}, {"largest_kappa_b", b}});
}

}  // namespace bight::coupling
