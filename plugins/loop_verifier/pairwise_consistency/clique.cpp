// SPDX-License-Identifier: BSD-3-Clause
#include "clique.hpp"

#include <algorithm>
#include <bit>
#include <limits>

namespace cambium::pcm {

Bits& Bits::operator&=(const Bits& other) {
  for (std::size_t w = 0; w < words_.size(); ++w) words_[w] &= other.words_[w];
  return *this;
}

Bits& Bits::remove(const Bits& other) {
  for (std::size_t w = 0; w < words_.size(); ++w) words_[w] &= ~other.words_[w];
  return *this;
}

std::size_t Bits::first() const {
  for (std::size_t w = 0; w < words_.size(); ++w)
    if (words_[w]) return 64 * w + std::size_t(std::countr_zero(words_[w]));
  return npos;
}

std::size_t Bits::count() const {
  std::size_t n = 0;
  for (const std::uint64_t w : words_) n += std::size_t(std::popcount(w));
  return n;
}

namespace {

class Search {
 public:
  Search(const CliqueProblem& problem, const Bits& allowed) : problem_(problem) {
    start_with_greedy(allowed);
    expand(allowed, 0);  // the size
    ties_ = true;
    const bool size_known = branches_ <= problem.branch_limit;
    branches_ = 0;
    if (size_known) expand(allowed, 0);  // the best of that size
    best_.exact = size_known;
  }

  Clique best() && { return std::move(best_); }

 private:
  struct Coloured {
    std::size_t vertex, colour;
  };

  /// Vertices by greedy colour: no clique among the first k is larger than the k-th's colour.
  std::vector<Coloured> coloured(Bits rest) const {
    std::vector<Coloured> out;
    for (std::size_t colour = 1; rest.first() != Bits::npos; ++colour) {
      Bits independent = rest;
      for (std::size_t v; (v = independent.first()) != Bits::npos;) {
        out.push_back({v, colour});
        rest.reset(v);
        independent.reset(v);
        independent.remove(problem_.neighbours[v]);
      }
    }
    return out;
  }

  /// A first bound: the vertex with most neighbours left, again and again.
  void start_with_greedy(Bits rest) {
    while (rest.first() != Bits::npos) {
      std::size_t best = 0, most = 0;
      Bits left = rest;
      for (std::size_t v; (v = left.first()) != Bits::npos; left.reset(v)) {
        Bits common = rest;
        const std::size_t n = 1 + (common &= problem_.neighbours[v]).count();
        if (n > most) most = n, best = v;
      }
      current_.push_back(best);
      rest &= problem_.neighbours[best];
    }
    report();
    current_.clear();
  }

  /// `sum` is that of the distances in current_; it only grows.
  void expand(Bits candidates, double sum) {
    if (++branches_ > problem_.branch_limit) return;
    if (branches_ % 256 == 0) problem_.check_cancelled();
    const auto order = coloured(candidates);
    for (auto it = order.rbegin(); it != order.rend(); ++it) {
      const std::size_t bound = current_.size() + it->colour;
      if (ties_ ? bound < best_.members.size() : bound <= best_.members.size()) return;
      double with = sum;
      if (ties_)
        for (const std::size_t u : current_) with += problem_.distance(u, it->vertex);
      if (!ties_ || with <= (1 + 1e-9) * best_sum_) {
        current_.push_back(it->vertex);
        Bits common = candidates;
        if ((common &= problem_.neighbours[it->vertex]).first() == Bits::npos)
          report();
        else
          expand(common, with);
        current_.pop_back();
      }
      if (branches_ > problem_.branch_limit) return;
      candidates.reset(it->vertex);
    }
  }

  void report() {
    std::vector<std::size_t> members = current_;
    std::sort(members.begin(), members.end());
    if (members.size() < best_.members.size()) return;
    double sum = 0;  // in ascending order: the same bits however the clique was found
    for (std::size_t a = 0; a < members.size(); ++a)
      for (std::size_t b = a + 1; b < members.size(); ++b)
        sum += problem_.distance(members[a], members[b]);
    const bool better = members.size() > best_.members.size() || sum < best_sum_ ||
                        (sum == best_sum_ && members < best_.members);
    if (!better) return;
    best_.members = std::move(members);
    best_sum_ = sum;
  }

  const CliqueProblem& problem_;
  std::vector<std::size_t> current_;
  Clique best_;
  double best_sum_ = std::numeric_limits<double>::infinity();
  std::size_t branches_ = 0;
  bool ties_ = false;
};

}  // namespace

Clique maximum_clique(const CliqueProblem& problem, const Bits& allowed) {
  return Search(problem, allowed).best();
}

}  // namespace cambium::pcm
