#include "coupling/report_states.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <regex>

#include "coupling/errors.h"
#include "coupling/evenly.h"
#include "coupling/files.h"
#include "coupling/pack.h"
#include "coupling/read_surface.h"
#include "coupling/read_table.h"

namespace bight::coupling {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// What a reader wants to see of the solid; the gap to strands far away is of no use.
constexpr const char* surface_fields[] = {"contact_pressure", "von_mises", "J", "pressure"};

struct State {
  std::string name;  // "ebar_+020.000"
  double ebar = 0;
  bool in_rod = false, in_solid = false;
};

// In the order of the run; the .pvd lists a state once its files are whole.
void add_states(const fs::path& folder, const std::string& fidelity, bool State::*in,
                std::vector<State>& states) {
  const fs::path series = folder / fidelity / (fidelity + ".pvd");
  if (!fs::exists(series)) return;
  const std::string text = read_whole(series);
  const std::regex entry("timestep=\"([^\"]+)\"[^>]*file=\"vtu/([^\"]+)\\.vtu\"");
  for (std::sregex_iterator at(text.begin(), text.end(), entry), end; at != end; ++at) {
    auto state = std::ranges::find(states, (*at)[2].str(), &State::name);
    if (state == states.end()) state = states.insert(states.end(), {(*at)[2], std::stod((*at)[1])});
    (*state).*in = true;
  }
}

Json packed_columns(const fs::path& csv) {
  const Table table = read_table(csv);
  Json columns = Json::object();
  for (size_t k = 0; k < table.names.size(); ++k) {
    std::vector<double> values;
    for (const auto& row : table.rows) values.push_back(row[k]);
    columns[table.names[k]] = pack(values);
  }
  return columns;
}

Json packed_surface(const Surface& surface, double diameter) {
  Json result = Json::object();
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    for (const Vector3& point : surface.points) values.push_back(point[axis] / diameter);
    result[std::string(1, "xyz"[axis])] = pack(values);
  }
  for (const char* name : surface_fields)
    if (const auto field = surface.fields.find(name); field != surface.fields.end())
      result[name] = pack(field->second);
  return result;
}

// The states of a run share one mesh.
class SurfaceReader {
 public:
  explicit SurfaceReader(double diameter) : diameter_(diameter) {}

  Json read(const fs::path& vtu) {
    const Surface surface = read_surface(vtu);
    if (!quads_.empty() && surface.quads != quads_)
      throw FileError(vtu.string() + ": another mesh than that of the states before");
    quads_ = surface.quads;
    return packed_surface(surface, diameter_);
  }

  Json quads() const {
    std::vector<std::uint32_t> corners;
    for (const auto& quad : quads_) corners.insert(corners.end(), quad.begin(), quad.end());
    return pack(corners);
  }

 private:
  double diameter_;
  std::vector<std::array<std::uint32_t, 4>> quads_;
};

// The longest evenly thinned list that takes at most `bytes`.
Json thinned(const std::vector<Json>& states, size_t bytes) {
  std::vector<size_t> sizes;
  for (const Json& state : states) sizes.push_back(state.dump().size());
  for (size_t most = states.size();; --most) {
    const std::vector<size_t> chosen = evenly(states.size(), most);
    size_t taken = 0;
    for (const size_t i : chosen) taken += sizes[i] + 1;
    if (taken > bytes) continue;
    Json list = Json::array();
    for (const size_t i : chosen) list.push_back(states[i]);
    return list;
  }
}

}  // namespace

Json report_states(const fs::path& folder, double diameter, size_t most, size_t bytes) {
  std::vector<State> recorded;
  add_states(folder, "rod", &State::in_rod, recorded);
  add_states(folder, "solid", &State::in_solid, recorded);

  SurfaceReader surfaces(diameter);
  std::vector<Json> states;
  for (const size_t i : evenly(recorded.size(), most)) {
    const State& state = recorded[i];
    Json& json = states.emplace_back(Json{{"name", state.name}, {"ebar", state.ebar}});
    const fs::path centerline = fs::path("centerline") / (state.name + ".csv");
    if (state.in_rod) json["rod"] = packed_columns(folder / "rod" / centerline);
    const fs::path contacts = folder / "rod" / "contacts" / (state.name + ".csv");
    if (state.in_rod && fs::exists(contacts)) json["contacts"] = packed_columns(contacts);
    if (state.in_solid) json["solid"] = packed_columns(folder / "solid" / centerline);
    if (state.in_solid)
      json["surface"] = surfaces.read(folder / "solid" / "vtu" / (state.name + ".vtu"));
  }
  Json result = {{"recorded", recorded.size()}, {"quads", surfaces.quads()}};
  const size_t left = bytes - std::min(bytes, result.dump().size());
  result["list"] = thinned(states, left);
  return result;
}

}  // namespace bight::coupling
