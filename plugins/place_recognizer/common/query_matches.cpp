// SPDX-License-Identifier: BSD-3-Clause
// From what is plausible to the matches: the second half of QuerySearch.
#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "common/distance.hpp"
#include "common/query_search.hpp"

namespace columns {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// The vertex of the parabola through three samples one apart, relative to the middle one.
double parabola_vertex(double left, double middle, double right) {
  const double curvature = left - 2.0 * middle + right;
  if (!std::isfinite(curvature) || curvature <= 0.0) return 0.0;
  return std::clamp(0.5 * (left - right) / curvature, -0.5, 0.5);
}

}  // namespace

Match QuerySearch::best_of(std::span<const Plausible> of_reference) const {
  Match best{of_reference.front().reference, 0, infinity, 0.0};
  for (const Plausible& p : of_reference) {  // by view, then by shift: the first of equals stays
    const double d = distance_at(views_[p.view], p.reference, p.shift);
    if (d < best.distance) best = {p.reference, p.view, d, double(p.shift)};
  }
  return best;
}

double QuerySearch::refined(const Match& match, std::size_t shift) const {
  const std::size_t sectors = in_common_.size();
  const auto at = [&](std::size_t k) {
    return distance_at(views_[match.view], match.reference, k % sectors);
  };
  const double finer = parabola_vertex(at(shift + sectors - 1), match.distance, at(shift + 1));
  return std::remainder(double(shift) + finer, double(sectors));
}

std::vector<std::span<const QuerySearch::Plausible>> QuerySearch::by_reference() const {
  std::vector<std::span<const Plausible>> out;
  for (auto first = plausible_.begin(); first != plausible_.end();) {
    const auto last = std::find_if(first, plausible_.end(), [&](const Plausible& p) {
      return p.reference != first->reference;
    });
    out.emplace_back(first, last);
    first = last;
  }
  return out;
}

void QuerySearch::narrow() {
  const Shape shape = task_.references.shape;
  const double error = rounding_of_dot(shape.bins()) * (1.0 + 1e-6) * shape.sectors;
  Smallest nearest(std::size_t(task_.limits.candidates), task_.limits.threshold);
  double upper = infinity;
  for (std::size_t i = 0; i < plausible_.size(); ++i) {
    Plausible& p = plausible_[i];
    const float* query = views_[p.view].descriptor.data();
    const float* reference = task_.references.descriptor(p.reference, 0).data();
    const std::size_t wrapped = std::size_t(p.shift) * std::size_t(shape.rings);
    const std::size_t straight = shape.bins() - wrapped;
    const double sum = double(task_.kernel.dot(query, reference + wrapped, straight)) +
                       double(task_.kernel.dot(query + straight, reference, wrapped));
    const int n = columns_in_common(views_[p.view], p.reference, p.shift);
    p.lower = distance(sum + error, n, least_columns_) - slack;
    upper = std::min(upper, distance(sum - error, n, least_columns_) + slack);
    if (i + 1 < plausible_.size() && plausible_[i + 1].reference == p.reference) continue;
    nearest.add(upper);
    upper = infinity;
  }
  std::erase_if(plausible_, [&](const Plausible& p) { return p.lower > nearest.bar(); });
}

std::vector<Match> QuerySearch::matches() {
  std::erase_if(plausible_, [&](const Plausible& p) { return p.lower > nearest_.bar(); });
  std::sort(plausible_.begin(), plausible_.end(), [](const Plausible& a, const Plausible& b) {
    return std::tie(a.reference, a.view, a.shift) < std::tie(b.reference, b.view, b.shift);
  });
  narrow();
  std::vector<Match> found;
  for (const auto of_reference : by_reference()) found.push_back(best_of(of_reference));
  std::erase_if(found, [&](const Match& m) { return m.distance > task_.limits.threshold; });
  std::sort(found.begin(), found.end(), [](const Match& a, const Match& b) {
    return std::tie(a.distance, a.reference) < std::tie(b.distance, b.reference);
  });
  found.resize(std::min(found.size(), std::size_t(task_.limits.candidates)));
  for (Match& m : found) m.shift = refined(m, std::size_t(m.shift));
  return found;
}

}  // namespace columns
