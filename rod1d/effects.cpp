#include "rod1d/effects.h"

#include "rod1d/effects/bend.h"
#include "rod1d/effects/gravity.h"
#include "rod1d/effects/magnetic.h"
#include "rod1d/effects/natural_bend.h"
#include "rod1d/effects/stretch.h"
#include "rod1d/effects/twist.h"

namespace bight::rod1d {

namespace {

/// Of the quadrature points of contact [D].
constexpr double contact_spacing = 0.02;

}  // namespace

RodEffects make_effects(const Rod& rod, const RodParameters& parameters, const Frames& source) {
  RodEffects effects;
  const auto add = [&](auto effect) {
    auto* raw = effect.get();
    effects.list.push_back(std::move(effect));
    return raw;
  };
  add(std::make_unique<Stretch>(rod));
  if (rod.straight()) add(std::make_unique<Bend>(rod));
  if (!rod.straight()) add(std::make_unique<NaturalBend>(rod, source));
  if (parameters.twist) add(std::make_unique<Twist>(rod, source));
  if (parameters.gravity != Vector3::Zero()) add(gravity(rod, parameters.gravity));
  if (parameters.magnetic != Vector3::Zero())
    add(std::make_unique<Magnetic>(rod, parameters.magnetic));
  if (parameters.contact) effects.contact = add(std::make_unique<Contact>(rod, contact_spacing));
  if (parameters.friction > 0)
    effects.friction = add(std::make_unique<Friction>(
        rod, *effects.contact, parameters.friction,
        parameters.friction_at_surface ? SlipOf::surface : SlipOf::centerline));
  return effects;
}

}  // namespace bight::rod1d
