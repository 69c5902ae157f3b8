// SPDX-License-Identifier: BSD-3-Clause
// What all loops between two rigid bodies say together about where one lies in the other.
#pragma once
#include <vector>

#include "cambium/se3.hpp"

namespace cambium {

/// A loop between two rigid bodies: T_first_second as it alone would have it, and where in `second`
/// it acts.
struct Tie {
  SE3 T_first_second;
  Vec3 p_second = Vec3::Zero();
};

/// Every tie stands for four points, its place and one this far from it along each axis: so the
/// rotation that a single tie measures counts like one measured by points at this distance [m].
constexpr double tie_lever = 10;

/// The consensus of the ties of one pair, and all that a joint estimate needs of them: with the
/// points p of `second` that stand for the ties that agree, the mean of |T p - T_first_second p|^2
/// follows from their centre and scatter for any T.
struct PairFit {
  SE3 T_first_second;
  Vec3 centre = Vec3::Zero();   ///< mean of the points, in `second`
  Mat3 scatter = Mat3::Zero();  ///< mean of (p - centre)(p - centre)'
  std::size_t agreeing = 0;     ///< ties; not all need to agree

  /// Root mean square over the points by which T moves them away from where the fit has them [m].
  double distance(const SE3& T) const;
};

/// Least median of squares over the ties themselves (Rousseeuw 1984), right with up to half of them
/// wrong; then the least-squares fit of all that agree with it. `ties` holds at least one; the
/// order of equal ties does not matter, as the fit is over a set that the median decides.
PairFit fit_pair(const std::vector<Tie>& ties);

}  // namespace cambium
