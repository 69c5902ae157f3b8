// SPDX-License-Identifier: BSD-3-Clause
// Whether a fitted stem is one of a tree.
#pragma once
#include "stem_fit.hpp"

namespace stem_extraction {

struct Judgement {
  double reach = 0;       ///< up to where the stem can be followed [m]
  double continuity = 0;  ///< share of the layers of a quarter of a metre below that show it, 0..1
  double inside = 0;      ///< points inside the stem for each one on its surface
  double score = 0;       ///< 0..1: continuity, coverage, spread and emptiness together
};

/// A layer shows the stem when more points lie on its surface than a crown of the density around
/// it would put there.
Judgement judge(const Stem& stem, const Points& points);

}  // namespace stem_extraction
