#pragma once

#include <cstddef>
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

/// What an effect brings to a system, and how long it has taken.
struct EffectCost {
  std::string name;
  int stencils = 0;         ///< that may carry energy at present
  int unknowns = 0;         ///< that no effect before it in the list depends on
  std::size_t entries = 0;  ///< of the Hessian's pattern, beyond those of the effects before it
  double seconds = 0;       ///< wall, in finding and computing its stencils
};

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

  /// What each effect of the list costs. `before`: seconds by effect of assemblers that this one
  /// has replaced. Walks all couplings: not for every step.
  std::vector<EffectCost> costs(const std::map<std::string, double>& before = {}) const;

  /// Wall seconds by effect so far.
  const std::map<std::string, double>& seconds_by_effect() const { return seconds_by_effect_; }

  const Unknowns& unknowns() const { return unknowns_; }
  const EffectList& effects() const { return effects_; }

 private:
  struct Chunk;
  void build_pattern();
  void couple(const Effect& effect, std::vector<std::vector<int>>& rows) const;
  bool scatter(const Chunk& chunk, int thread, int threads);
  std::int64_t find_block(int column_block, int row_block) const;

  const Unknowns& unknowns_;
  const EffectList& effects_;
  SymmetricMatrix hessian_;
  /// By column block: its row blocks, ascending, and the offset of each inside a column.
  std::vector<int> block_start_, block_row_, block_offset_;
  int pattern_version_ = 0;
  std::map<std::string, double> energy_by_effect_, seconds_by_effect_;
  std::unique_ptr<Chunk> chunk_;  ///< kept, since it is allocated memory all over
};

}  // namespace bight
