#include "coupling/scene_material.h"

#include <fmt/format.h>

#include <cmath>
#include <numeric>

namespace bight::coupling {
namespace {

/// A key that belongs to one model.
struct ModelKey {
  const char *key, *model;
};
constexpr ModelKey model_keys[] = {{"material.c10", "mooney-rivlin"},
                                   {"material.c01", "mooney-rivlin"},
                                   {"material.ogden_moduli", "ogden"},
                                   {"material.ogden_exponents", "ogden"}};

std::vector<double> list(const Values& values, const char* key) {
  return values.get<std::vector<double>>(key);
}

}  // namespace

double moduli_sum(const Values& values) {
  if (values.word("material.model") == "mooney-rivlin")
    return 2 * (values.number("material.c10") + values.number("material.c01"));
  const auto moduli = list(values, "material.ogden_moduli");
  return std::accumulate(moduli.begin(), moduli.end(), 0.0);
}

double youngs_modulus_of(double shear_modulus, const Values& values) {
  const double k = values.number("material.bulk_to_shear");
  return 9 * k / (3 * k + 1) * shear_modulus;
}

solid3d::MaterialParameters material_parameters(const Values& values) {
  solid3d::MaterialParameters material;
  material.model = values.word("material.model");
  material.bulk_to_shear = values.number("material.bulk_to_shear");
  const double sum = moduli_sum(values);
  if (!(sum > 0)) return material;
  material.c01_share = 2 * values.number("material.c01") / sum;
  const auto moduli = list(values, "material.ogden_moduli");
  const auto exponents = list(values, "material.ogden_exponents");
  if (moduli.empty() || moduli.size() != exponents.size()) return material;
  material.ogden.clear();
  for (size_t i = 0; i < moduli.size(); ++i)
    material.ogden.push_back({moduli[i] / sum, exponents[i]});
  return material;
}

void check_moduli(const Values& values, Problems& problems) {
  constexpr size_t most_terms = 3;
  const std::string model = values.word("material.model");
  bool complete = true;
  const auto refuse = [&](const char* key, const std::string& what) {
    problems.add(values.where(key), key, what);
    complete = false;
  };
  for (const auto& [key, of] : model_keys) {
    if (model == of && !values.has(key)) refuse(key, "missing; " + model + " needs it");
    if (model != of && values.has(key))
      refuse(key, fmt::format("belongs to model {}, not {}", of, model));
  }
  if (!complete || moduli_sum(values) == 0) return;
  const double sum = moduli_sum(values);
  if (model == "ogden") {
    const auto moduli = list(values, "material.ogden_moduli");
    const auto exponents = list(values, "material.ogden_exponents");
    if (moduli.size() != exponents.size() || moduli.size() > most_terms)
      refuse("material.ogden_exponents",
             fmt::format("give as many as moduli, at most {}; here are {} and {}", most_terms,
                         exponents.size(), moduli.size()));
    for (const double exponent : exponents)
      if (exponent == 0) refuse("material.ogden_exponents", "an exponent of 0 stores no energy");
    if (!(sum > 0))
      refuse("material.ogden_moduli", "their sum, the shear modulus, is not positive");
  }
  const double E = youngs_modulus_of(sum, values), given = values.number("material.youngs_modulus");
  if (complete && std::abs(given - E) > 1e-6 * E)
    refuse("material.youngs_modulus",
           fmt::format("{:.9g} Pa, but the moduli mean {:.9g} Pa; leave it out", given, E));
}

}  // namespace bight::coupling
