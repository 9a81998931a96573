#pragma once

#include "mechanics/newton.h"
#include "rod1d/rod_model.h"

namespace bight::rod1d {

/// What has to be set up anew when other coordinates are held.
struct RodModel::Equations {
  Unknowns unknowns;
  Assembler assembler;
  SparseCholesky cholesky;
  System system;

  Equations(const std::vector<int>& blocks, const std::vector<bool>& held,
            const std::vector<Image>& images, const EffectList& effects)
      : unknowns(blocks, static_cast<int>(held.size()), held, {}, images),
        assembler(unknowns, effects),
        system{assembler, cholesky, Ordering::minimum_degree,
               [this](Vector& x, const Vector& dx) { unknowns.advance(x, dx); }} {}
};

}  // namespace bight::rod1d
