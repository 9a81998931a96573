#include "rod1d/effects.h"

#include "rod1d/effects/bend.h"
#include "rod1d/effects/stretch.h"

namespace bight::rod1d {

namespace {

/// Of the quadrature points of contact [D].
constexpr double contact_spacing = 0.03;

}  // namespace

RodEffects make_effects(const Rod& rod, const RodParameters& parameters) {
  RodEffects effects;
  const auto add = [&](auto effect) {
    auto* raw = effect.get();
    effects.list.push_back(std::move(effect));
    return raw;
  };
  add(std::make_unique<Stretch>(rod));
  add(std::make_unique<Bend>(rod));
  if (parameters.contact) effects.contact = add(std::make_unique<Contact>(rod, contact_spacing));
  return effects;
}

}  // namespace bight::rod1d
