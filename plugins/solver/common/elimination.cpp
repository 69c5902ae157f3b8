// SPDX-License-Identifier: BSD-3-Clause
#include "common/elimination.hpp"

#include <algorithm>
#include <limits>

namespace cambium::pose_solver {
namespace {

/// The lower triangle, diagonal included, of a matrix with these couplings of unknowns.
LowerPattern lower(int count, const std::vector<std::pair<int, int>>& couplings) {
  std::vector<std::vector<int>> below(static_cast<std::size_t>(count));
  for (const auto& [a, b] : couplings) below[std::size_t(std::min(a, b))].push_back(std::max(a, b));
  LowerPattern out;
  for (int c = 0; c < count; ++c) {
    auto& rows = below[std::size_t(c)];
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    out.column_start.push_back(int(out.row.size()));
    out.row.push_back(c);
    out.row.insert(out.row.end(), rows.begin(), rows.end());
  }
  out.column_start.push_back(int(out.row.size()));
  return out;
}

template <class Change>
void* copy(const void* from, std::size_t count, cholmod_common* common, const Change& change) {
  auto* out = static_cast<int*>(cholmod_malloc(count, sizeof(int), common));
  const auto* in = static_cast<const int*>(from);
  for (std::size_t i = 0; out && i < count; ++i) out[i] = change(in[i]);
  return out;
}

}  // namespace

Elimination::Elimination(const PoseGraph& graph, const std::vector<bool>& held,
                         const std::vector<bool>& use)
    : place_(held.size(), -1) {
  for (std::size_t i = 0; i < held.size(); ++i)
    if (!held[i]) place_[i] = count_++;
  const auto couplings = [&] {
    Couplings out;
    for (std::size_t k = 0; k < graph.relative.size(); ++k)
      if (const auto& f = graph.relative[k]; (use.empty() || use[k]) && couples(f))
        out.emplace_back(place_[f.tail], place_[f.head]);
    return out;
  };
  find_order(couplings());
  pattern_ = lower(count_, couplings());
}

// Minimum degree, or nested dissection when that fills less; it takes five times as long to find,
// which pays when factors are expensive. Merging small supernodes costs zeros and saves calls of
// BLAS; these limits, for blocks of six, were the best for factorising and solving on sphere2500,
// torus3D and parking-garage. The defaults are made for scalars.
void Elimination::find_order(const Couplings& couplings) {
  constexpr double expensive = 1000;  // multiplications of blocks per pose
  settings_->nmethods = 1;
  settings_->postorder = 1;  // neighbours in the elimination tree side by side
  settings_->supernodal = CHOLMOD_SUPERNODAL;
  settings_->nrelax[0] = 1, settings_->nrelax[1] = 3, settings_->nrelax[2] = 8;
  settings_->zrelax[1] = 0.2, settings_->zrelax[2] = 0.05;
  const LowerPattern any_order = lower(count_, couplings);
  cholmod_sparse A = view(any_order, nullptr);
  settings_->method[0].ordering = CHOLMOD_AMD;
  factor_ = cholmod_analyze(&A, settings_);
  if (const double cost = settings_->fl; factor_ && cost > expensive * count_) {
    settings_->method[0].ordering = CHOLMOD_METIS;
    cholmod_factor* other = cholmod_analyze(&A, settings_);
    if (other && settings_->fl < cost) std::swap(factor_, other);
    cholmod_free_factor(&other, settings_);
  }
  if (!factor_) return;
  std::vector<int> turn(static_cast<std::size_t>(count_));
  for (int k = 0; k < count_; ++k) turn[std::size_t(static_cast<const int*>(factor_->Perm)[k])] = k;
  for (int& p : place_)
    if (p >= 0) p = turn[std::size_t(p)];
}

Elimination::~Elimination() { cholmod_free_factor(&factor_, settings_); }

cholmod_factor* Elimination::symbolic_factor(int block, cholmod_common* common) const {
  const auto b = std::size_t(block);
  constexpr auto largest = std::size_t(std::numeric_limits<int>::max());
  if (!factor_ || factor_->xsize > largest / (b * b)) return nullptr;
  cholmod_factor* out = cholmod_allocate_factor(b * factor_->n, common);
  if (!out) return nullptr;
  out->ordering = CHOLMOD_NATURAL;  // places are in the order of elimination: Perm is the identity
  if (block == 1) {                 // supernodes of a few numbers do not pay
    std::copy_n(static_cast<const int*>(factor_->ColCount), factor_->n,
                static_cast<int*>(out->ColCount));
    return out;
  }
  const auto times = [](int k) { return [k](int i) { return k * i; }; };
  const std::size_t supernodes = factor_->nsuper;
  out->is_ll = out->is_super = 1;
  out->nsuper = supernodes;
  out->ssize = b * factor_->ssize;
  out->xsize = b * b * factor_->xsize;
  out->maxcsize = b * b * factor_->maxcsize;
  out->maxesize = b * factor_->maxesize;
  out->super = copy(factor_->super, supernodes + 1, common, times(block));
  out->pi = copy(factor_->pi, supernodes + 1, common, times(block));
  out->px = copy(factor_->px, supernodes + 1, common, times(block * block));
  auto* rows = static_cast<int*>(cholmod_malloc(out->ssize, sizeof(int), common));
  for (std::size_t i = 0; rows && i < out->ssize; ++i)
    rows[i] = block * static_cast<const int*>(factor_->s)[i / b] + int(i % b);
  out->s = rows;
  if (common->status != CHOLMOD_OK) cholmod_free_factor(&out, common);
  return out;
}

}  // namespace cambium::pose_solver
