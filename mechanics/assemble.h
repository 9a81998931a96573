#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "mechanics/effect.h"
#include "mechanics/sparse_cholesky.h"
#include "mechanics/unknowns.h"

namespace bight {

using EffectList = std::vector<std::unique_ptr<Effect>>;

/// Sums the elements of a list of effects to energy, gradient and Hessian.
///
/// Elements are computed in parallel, and every sum is taken in the order of effects and stencils,
/// so the result does not depend on the number of threads. The pattern of the Hessian is kept as
/// long as it covers the stencils; effects pad it with what may touch soon.
class Assembler {
 public:
  Assembler(const Unknowns& unknowns, const EffectList& effects);
  ~Assembler();

  /// Lets the effects find their stencils for x. Call it before evaluating at a new x.
  void refresh(const Vector& x);

  /// Total energy [E D^3]; `inadmissible` as soon as one stencil is.
  double energy(const Vector& x);

  /// Energy, and by order the gradient by coordinates (held ones too: their reactions) and the
  /// Hessian by unknowns.
  double assemble(const Vector& x, Order order, Vector& gradient);

  const SymmetricMatrix& hessian() const { return hessian_; }
  /// Grows by one whenever the pattern of hessian() changes.
  int pattern_version() const { return pattern_version_; }

  /// Energy by effect of the last evaluation.
  const std::map<std::string, double>& energy_by_effect() const { return energy_by_effect_; }

  const Unknowns& unknowns() const { return unknowns_; }
  const EffectList& effects() const { return effects_; }

 private:
  struct Chunk;
  void build_pattern();
  bool scatter(const Chunk& chunk, int thread, int threads);
  std::int64_t find_block(int column_block, int row_block) const;

  const Unknowns& unknowns_;
  const EffectList& effects_;
  SymmetricMatrix hessian_;
  /// By column block: its row blocks, ascending, and the offset of each inside a column.
  std::vector<int> block_start_, block_row_, block_offset_;
  int pattern_version_ = 0;
  std::map<std::string, double> energy_by_effect_;
  std::unique_ptr<Chunk> chunk_;  ///< kept, since it is allocated memory all over
};

}  // namespace bight
