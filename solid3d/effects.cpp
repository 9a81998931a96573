#include "solid3d/effects.h"

#include <cassert>

#include "solid3d/effects/gravity.h"
#include "solid3d/elements.h"

namespace bight::solid3d {

namespace {

template <class T, class... Arguments>
T* add(EffectList& list, bool asked_for, Arguments&&... arguments) {
  if (!asked_for) return nullptr;
  auto effect = std::make_unique<T>(std::forward<Arguments>(arguments)...);
  T* raw = effect.get();
  list.push_back(std::move(effect));
  return raw;
}

}  // namespace

SolidEffects make_effects(std::span<const Mesh> strands, const SolidParameters& p,
                          int internal_begin, int first_layer) {
  const HexMesh mesh = hexahedra(strands);
  const HexElement& element = hex_element(p.element);
  assert(mesh.degree == element.degree);
  const int first_cell = strands[0].cells_before(first_layer);
  Contact::Options contact;
  contact.sample_spacing = p.sample_spacing;
  contact.largest_move = p.largest_move;
  contact.first_layer = first_layer;

  SolidEffects effects;
  effects.strain = add<Strain>(effects.list, true, mesh, internal_begin, make_material(p.material),
                               element.quadrature, first_cell);
  effects.hourglass = add<Hourglass>(effects.list, element.hourglass, mesh,
                                     p.material.shear_modulus(), p.hourglass_factor, first_cell);
  if (p.gravity != Vector3::Zero()) effects.list.push_back(gravity(mesh, p.gravity));
  effects.contact = add<Contact>(effects.list, p.contact, strands,
                                 ContactLaw{p.contact_stiffness, p.contact_onset}, contact);
  if (effects.contact)
    effects.friction = add<Friction>(effects.list, p.friction > 0, *effects.contact, p.friction);
  return effects;
}

}  // namespace bight::solid3d
