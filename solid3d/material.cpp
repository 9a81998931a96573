#include "solid3d/material.h"

#include <stdexcept>
#include <utility>

namespace bight::solid3d {

namespace {

/// Calls visit with a null pointer to each type of the list, in its order.
template <class Visit, size_t... i>
void for_each_material(Visit&& visit, std::index_sequence<i...>) {
  (visit(static_cast<std::variant_alternative_t<i, Material>*>(nullptr)), ...);
}
constexpr auto all = std::make_index_sequence<std::variant_size_v<Material>>();

}  // namespace

Material make_material(const MaterialParameters& parameters) {
  Material material;
  bool found = false;
  for_each_material(
      [&]<class T>(T*) {
        if (T::name != parameters.model) return;
        material = T::from(parameters);
        found = true;
      },
      all);
  if (!found) throw std::invalid_argument("no material is called " + parameters.model);
  return material;
}

std::vector<std::string_view> material_names() {
  std::vector<std::string_view> names;
  for_each_material([&]<class T>(T*) { names.push_back(T::name); }, all);
  return names;
}

}  // namespace bight::solid3d
