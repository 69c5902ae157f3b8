// SPDX-License-Identifier: BSD-3-Clause
#include "common/query_search.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "common/distance.hpp"

namespace columns {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

void Smallest::add(double distance) {
  if (distance > bar()) return;
  heap_.push_back(distance);
  std::push_heap(heap_.begin(), heap_.end());
  if (heap_.size() <= count_) return;
  std::pop_heap(heap_.begin(), heap_.end());
  heap_.pop_back();
}

QuerySearch::QuerySearch(const Task& task, const Table& queries, std::size_t query,
                         const Transform& transform)
    : task_(task),
      query_(query),
      least_columns_(std::max(1.0, std::ceil(task.limits.min_overlap * queries.shape.sectors))),
      nearest_(std::size_t(task.limits.candidates), task.limits.threshold),
      in_common_(std::size_t(queries.shape.sectors)) {
  for (std::size_t v = 0; v < queries.views; ++v) {
    const auto descriptor = queries.descriptor(query, v);
    views_.push_back({descriptor, CoarseQuery(descriptor, transform)});
  }
}

unsigned QuerySearch::allowed_lanes(std::size_t tile) const {
  if (!task_.pairing.within_mission) return ~0u;
  unsigned bits = 0;
  const std::size_t first = tile * lanes;
  for (std::size_t r = first; r < std::min(first + lanes, task_.references.size()); ++r)
    bits |= unsigned(task_.pairing.allowed(query_, r)) << (r - first);
  return bits;
}

void QuerySearch::ask(std::size_t tile, Scratch& scratch) {
  allowed_ = allowed_lanes(tile);
  if (allowed_ == 0) return;
  for (const View& view : views_)
    scratch.screenings.push_back(
        {&view.coarse, float(nearest_.bar()), float(least_columns_),
         scratch.spectra.data() + scratch.screenings.size() * scratch.cross});
}

void QuerySearch::look_at(std::size_t tile, std::span<Screening>& answers,
                          std::vector<float>& sums) {
  if (allowed_ == 0) return;
  const std::byte* bytes = task_.references.tile(tile);
  double upper[lanes];
  std::fill_n(upper, lanes, infinity);
  unsigned seen = 0;
  for (std::size_t v = 0; v < views_.size(); ++v) {
    Screening& screened = answers[v];
    screened.possible &= allowed_;
    const unsigned good =
        screened.possible ? task_.kernel.weigh(task_.inverse, bytes, screened, sums.data()) : 0;
    for (unsigned left = good; left != 0; left &= left - 1) {
      const auto lane = std::size_t(std::countr_zero(left));
      keep_plausible(v, tile * lanes + lane, sums.data(), upper[lane]);
    }
    seen |= good;
  }
  answers = answers.subspan(views_.size());
  for (; seen != 0; seen &= seen - 1) nearest_.add(upper[std::countr_zero(seen)]);
}

int QuerySearch::columns_in_common(const View& view, std::size_t reference,
                                   std::size_t shift) const {
  const Shape shape = task_.references.shape;
  const TileLayout layout(shape);
  const std::byte* tile = task_.references.tile(reference / lanes);
  const std::size_t lane = reference % lanes;
  const int filled = int(read<float>(tile + layout.filled, lane));
  if (view.coarse.filled == shape.sectors) return filled;  // most scans: no counting needed
  if (filled == shape.sectors) return view.coarse.filled;
  std::uint64_t mask[most_words];
  std::memcpy(mask, tile + layout.masks + lane * shape.words() * 8, shape.words() * 8);
  return view.coarse.overlap.count(shift, {mask, shape.words()});
}

void QuerySearch::keep_plausible(std::size_t v, std::size_t reference, const float* sums,
                                 double& upper) {
  const View& view = views_[v];
  const TileLayout layout(task_.references.shape);
  const std::byte* tile = task_.references.tile(reference / lanes);
  const std::size_t lane = reference % lanes;
  const double error = double(view.coarse.per_error) * read<float>(tile + layout.error, lane) +
                       double(view.coarse.per_norm) * read<float>(tile + layout.norm, lane);
  double largest = -infinity;  // mean cosine that some shift has at least
  for (std::size_t k = 0; k < in_common_.size(); ++k) {
    in_common_[k] = columns_in_common(view, reference, k);
    if (in_common_[k] >= least_columns_)
      largest = std::max(largest, (sums[k * lanes + lane] - error) / in_common_[k]);
  }
  if (largest > -infinity) upper = std::min(upper, std::max(0.0, 1.0 - largest) + slack);
  const double bar = std::min(nearest_.bar(), upper);
  const double wanted = 1.0 - bar - 2.0 * slack;  // saves most divisions
  for (std::size_t k = 0; k < in_common_.size(); ++k) {
    const double sum = sums[k * lanes + lane] + error;
    if (sum < wanted * in_common_[k]) continue;
    const double lower = distance(sum, in_common_[k], least_columns_) - slack;
    if (lower <= bar)
      plausible_.push_back({lower, std::uint32_t(reference), std::uint16_t(v), std::uint16_t(k)});
  }
}

double QuerySearch::distance_at(const View& view, std::size_t reference, std::size_t shift) const {
  const Table& references = task_.references;
  return distance(
      correlation(view.descriptor, references.descriptor(reference, 0), references.shape, shift),
      columns_in_common(view, reference, shift), least_columns_);
}

}  // namespace columns
