// SPDX-License-Identifier: BSD-3-Clause
// What one of several processes computes of a wave, so that together they fill the cache.
#pragma once
#include <string>
#include <vector>

namespace cambium {

struct ResolvedPipeline;

/// A pair of missions, or every `slices`-th candidate of one, from the `slice`-th on.
struct SharePart {
  std::string query, reference;  ///< names; `reference` is not after `query`
  std::size_t slice = 0, slices = 1;
};

/// A wave is a run of `recognize` and `register` steps until something needs all their loops; it is
/// what can be cut into pairs of missions.
struct Share {
  std::size_t wave = 1;  ///< from 1
  std::vector<SharePart> parts;
};

/// For each step the wave that it belongs to; 0 = none.
std::vector<std::size_t> waves_of(const ResolvedPipeline& pipeline);

}  // namespace cambium
