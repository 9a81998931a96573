#include "rod1d/knots.h"

#include <stdexcept>
#include <string>

#include "rod1d/figure_eight.h"
#include "rod1d/overhand.h"

namespace bight::rod1d {

const std::vector<Knot>& all_knots() {
  static const std::vector<Knot> knots = {
      {"overhand", 3, loosest_overhand, overhand_start},
      {"figure-eight", 5, loosest_figure_eight, figure_eight_start},
  };
  return knots;
}

const Knot& find_knot(std::string_view name) {
  for (const Knot& knot : all_knots())
    if (knot.name == name) return knot;
  throw std::invalid_argument("no knot is called " + std::string(name));
}

}  // namespace bight::rod1d
