#include "mechanics/assemble.h"

#include <omp.h>

#include <algorithm>
#include <atomic>

#include "mechanics/timed.h"

namespace bight {

namespace {

/// Elements are computed and scattered by chunks of this many: small enough for the cache.
constexpr int chunk_size = 512;
/// Below this many stencils an effect is cheaper on one thread; of large ones, below fewer.
constexpr int parallel_from = 512, small_stencil = 54;

int threads_for(int stencils, size_t coordinates) {
  const double size = std::max(1.0, static_cast<double>(coordinates) / small_stencil);
  return stencils * size * size < parallel_from ? 1 : omp_get_max_threads();
}

}  // namespace

/// The elements of up to chunk_size stencils, by unknowns.
struct Assembler::Chunk {
  struct Entry {
    ElementSlot slot;
    std::vector<double> gradient, hessian;
    std::vector<int> unknown;  ///< per row of `hessian`; -1 where held
  };
  std::vector<Entry> entries{chunk_size};
  int used = 0;
};

namespace {

/// Replaces the rows of carried points by one row for the turn that carries them:
/// H' = T^T H T + g . d2x/dangle2 on the angle's diagonal, with T = dx/d(unknowns).
template <class Entry>
void carry(const Unknowns& unknowns, std::span<const int> coordinates, const Vector& x,
           Entry& entry) {
  const int m = static_cast<int>(coordinates.size());
  std::vector<int> column(m, -1), turn_column(unknowns.turns().size(), -1);
  std::vector<int> unknown;
  for (int i = 0; i < m; ++i) {
    const int t = unknowns.turn_of(coordinates[i]);
    if (t < 0) {
      column[i] = static_cast<int>(unknown.size());
      unknown.push_back(unknowns.index(coordinates[i]));
    } else if (turn_column[t] < 0) {
      turn_column[t] = static_cast<int>(unknown.size());
      unknown.push_back(unknowns.index(unknowns.turns()[t].angle));
    }
  }
  Eigen::MatrixXd T = Eigen::MatrixXd::Zero(m, static_cast<int>(unknown.size()));
  Eigen::VectorXd second = Eigen::VectorXd::Zero(static_cast<int>(unknown.size()));
  for (int i = 0; i < m; ++i) {
    const int t = unknowns.turn_of(coordinates[i]);
    if (t < 0) {
      T(i, column[i]) = unknowns.sign(coordinates[i]);
      continue;
    }
    const Turn& turn = unknowns.turns()[t];
    // Carried points come as whole triples, each starting at a carried coordinate.
    const int first = *std::find_if(turn.carried.begin(), turn.carried.end(), [&](int c) {
      return c <= coordinates[i] && coordinates[i] < c + 3;
    });
    const int axis = coordinates[i] - first;
    const Vector3 position = x.segment<3>(first);
    T(i, turn_column[t]) = unknowns.sign(turn.angle) * Unknowns::velocity(turn, position)[axis];
    second[turn_column[t]] += entry.gradient[i] * Unknowns::acceleration(turn, position)[axis];
  }
  const Eigen::Map<const Eigen::MatrixXd> H(entry.hessian.data(), m, m);
  Eigen::MatrixXd reduced = T.transpose() * H * T;
  reduced.diagonal() += second;
  entry.hessian.assign(reduced.data(), reduced.data() + reduced.size());
  entry.unknown = std::move(unknown);
}

/// H' = S H S with the signs S of images.
template <class Entry>
void apply_signs(const Unknowns& unknowns, std::span<const int> coordinates, Entry& entry) {
  const int m = static_cast<int>(coordinates.size());
  Eigen::Map<Eigen::MatrixXd> H(entry.hessian.data(), m, m);
  for (int i = 0; i < m; ++i)
    if (unknowns.sign(coordinates[i]) < 0) {
      H.row(i) = -H.row(i);
      H.col(i) = -H.col(i);
    }
}

/// Ascending, each once.
void sort_out(std::vector<int>& list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

bool touches_turn(const Unknowns& unknowns, std::span<const int> coordinates) {
  if (unknowns.turns().empty()) return false;
  for (int c : coordinates)
    if (unknowns.turn_of(c) >= 0) return true;
  return false;
}

}  // namespace

Assembler::Assembler(const Unknowns& unknowns, const EffectList& effects)
    : unknowns_(unknowns), effects_(effects), chunk_(std::make_unique<Chunk>()) {}

Assembler::~Assembler() = default;

void Assembler::refresh(const Vector& x) {
  for (const auto& effect : effects_) {
    const Timed timed(seconds_by_effect_[std::string(effect->name())]);
    effect->refresh(x);
  }
}

double Assembler::energy(const Vector& x) {
  Vector unused;
  return assemble(x, Order::energy, unused);
}

double Assembler::assemble(const Vector& x, Order order, Vector& gradient) {
  if (order == Order::hessian && pattern_version_ == 0) build_pattern();
  if (order >= Order::gradient) gradient.setZero(x.size());
  if (order >= Order::hessian) std::fill(hessian_.value.begin(), hessian_.value.end(), 0.0);

  Chunk& chunk = *chunk_;
  double total = 0;
  bool covered = true;
  for (const auto& effect : effects_) {
    const Timed timed(seconds_by_effect_[std::string(effect->name())]);
    const int count = effect->stencils();
    const int threads = count == 0 ? 1 : threads_for(count, effect->coordinates(0).size());
    double sum = 0;
    for (int begin = 0; begin < count && total < inadmissible; begin += chunk_size) {
      chunk.used = std::min(chunk_size, count - begin);
#pragma omp parallel for schedule(dynamic, 8) num_threads(threads) if (threads > 1)
      for (int k = 0; k < chunk.used; ++k) {
        auto& entry = chunk.entries[k];
        const auto coordinates = effect->coordinates(begin + k);
        const size_t m = coordinates.size();
        entry.gradient.assign(order >= Order::gradient ? m : 0, 0.0);
        entry.hessian.assign(order >= Order::hessian ? m * m : 0, 0.0);
        entry.slot = {0.0, entry.gradient.data(), entry.hessian.data(), false};
        effect->element(x, begin + k, order, entry.slot);
        if (order < Order::hessian || entry.slot.empty) continue;
        if (touches_turn(unknowns_, coordinates)) {
          carry(unknowns_, coordinates, x, entry);
        } else {
          entry.unknown.resize(m);
          for (size_t i = 0; i < m; ++i) entry.unknown[i] = unknowns_.index(coordinates[i]);
          if (unknowns_.has_images()) apply_signs(unknowns_, coordinates, entry);
        }
      }
      for (int k = 0; k < chunk.used; ++k) {
        sum += chunk.entries[k].slot.energy;
        if (order < Order::gradient || chunk.entries[k].slot.empty) continue;
        const auto coordinates = effect->coordinates(begin + k);
        for (size_t i = 0; i < coordinates.size(); ++i)
          gradient[coordinates[i]] += chunk.entries[k].gradient[i];
      }
      if (!(sum < inadmissible)) break;
      if (order < Order::hessian) continue;
      std::atomic<bool> all{true};
#pragma omp parallel num_threads(threads) if (threads > 1)
      if (!scatter(chunk, omp_get_thread_num(), omp_get_num_threads())) all = false;
      covered = covered && all;
    }
    energy_by_effect_[std::string(effect->name())] = sum;
    total = sum < inadmissible ? total + sum : inadmissible;
    if (!(total < inadmissible)) return inadmissible;
  }
  if (!covered) {
    build_pattern();
    return assemble(x, order, gradient);
  }
  return total;
}

/// Adds the columns that this thread owns; false when a block is missing in the pattern.
bool Assembler::scatter(const Chunk& chunk, int thread, int threads) {
  bool covered = true;
  struct Run {
    int block, first, count;
  };
  std::vector<Run> runs;
  for (int k = 0; k < chunk.used; ++k) {
    const auto& entry = chunk.entries[k];
    if (entry.slot.empty) continue;
    const int m = static_cast<int>(entry.unknown.size());
    runs.clear();
    for (int i = 0; i < m; ++i) {
      if (entry.unknown[i] < 0) continue;
      const int block = unknowns_.block_of(entry.unknown[i]);
      if (!runs.empty() && runs.back().block == block &&
          entry.unknown[i] == entry.unknown[runs.back().first] + runs.back().count &&
          runs.back().first + runs.back().count == i)
        ++runs.back().count;
      else
        runs.push_back({block, i, 1});
    }
    for (const Run& column : runs) {
      if (column.block % threads != thread) continue;
      for (const Run& row : runs) {
        if (row.block < column.block) continue;
        const std::int64_t at = find_block(column.block, row.block);
        if (at < 0) {
          covered = false;
          continue;
        }
        const int row_shift = entry.unknown[row.first] - unknowns_.block_begin(row.block);
        for (int c = 0; c < column.count; ++c) {
          const int j = column.first + c;
          const double* from = entry.hessian.data() + static_cast<size_t>(j) * m + row.first;
          double* to =
              hessian_.value.data() + hessian_.column_start[entry.unknown[j]] + at + row_shift;
          for (int r = 0; r < row.count; ++r) to[r] += from[r];
        }
      }
    }
  }
  return covered;
}

std::int64_t Assembler::find_block(int column_block, int row_block) const {
  const auto begin = block_row_.begin() + block_start_[column_block];
  const auto end = block_row_.begin() + block_start_[column_block + 1];
  const auto it = std::lower_bound(begin, end, row_block);
  if (it == end || *it != row_block) return -1;
  return block_offset_[static_cast<size_t>(it - block_row_.begin())];
}

/// Adds to every block's column the rows that an effect couples it with, itself among them.
void Assembler::couple(const Effect& effect, std::vector<std::vector<int>>& rows) const {
  std::vector<int> clique;
  effect.couplings([&](std::span<const int> coordinates) {
    clique.clear();
    for (int c : coordinates) {
      const int turn = unknowns_.turn_of(c);
      const int u = unknowns_.index(turn < 0 ? c : unknowns_.turns()[turn].angle);
      if (u < 0) continue;
      const int block = unknowns_.block_of(u);
      if (clique.empty() || clique.back() != block) clique.push_back(block);
    }
    sort_out(clique);
    for (size_t i = 0; i < clique.size(); ++i) {
      auto& column = rows[clique[i]];
      // Keep the lists short: contact names the same pairs again and again.
      if (column.size() > 4096) sort_out(column);
      column.insert(column.end(), clique.begin() + static_cast<long>(i), clique.end());
    }
  });
}

std::vector<EffectCost> Assembler::costs(const std::map<std::string, double>& before) const {
  std::vector<EffectCost> costs;
  std::vector<std::vector<int>> rows(unknowns_.blocks());
  int unknowns = 0;
  std::size_t entries = 0;
  for (const auto& effect : effects_) {
    couple(*effect, rows);
    EffectCost cost{std::string(effect->name()), effect->stencils(), -unknowns, 0 - entries, 0};
    unknowns = 0, entries = 0;
    for (int b = 0; b < unknowns_.blocks(); ++b) {
      sort_out(rows[b]);
      const int size = unknowns_.block_size(b);
      if (!rows[b].empty()) unknowns += size;
      for (const int row : rows[b])
        entries += static_cast<std::size_t>(size * unknowns_.block_size(row));
    }
    cost.unknowns += unknowns, cost.entries += entries;
    for (const auto* seconds : {&seconds_by_effect_, &before})
      if (const auto found = seconds->find(cost.name); found != seconds->end())
        cost.seconds += found->second;
    costs.push_back(std::move(cost));
  }
  return costs;
}

void Assembler::build_pattern() {
  const int blocks = unknowns_.blocks();
  std::vector<std::vector<int>> rows(blocks);
  for (int b = 0; b < blocks; ++b) rows[b].push_back(b);
  for (const auto& effect : effects_) couple(*effect, rows);

  block_start_.assign(1, 0);
  block_row_.clear();
  block_offset_.clear();
  hessian_.column_start.assign(1, 0);
  hessian_.row.clear();
  for (int b = 0; b < blocks; ++b) {
    auto& column = rows[b];
    sort_out(column);
    int offset = 0;
    for (int row : column) {
      block_row_.push_back(row);
      block_offset_.push_back(offset);
      offset += unknowns_.block_size(row);
    }
    block_start_.push_back(static_cast<int>(block_row_.size()));
    for (int c = 0; c < unknowns_.block_size(b); ++c) {
      for (int row : column)
        for (int r = 0; r < unknowns_.block_size(row); ++r)
          hessian_.row.push_back(unknowns_.block_begin(row) + r);
      hessian_.column_start.push_back(static_cast<int>(hessian_.row.size()));
    }
    column = {};
  }
  hessian_.value.assign(hessian_.row.size(), 0.0);
  ++pattern_version_;
}

}  // namespace bight
