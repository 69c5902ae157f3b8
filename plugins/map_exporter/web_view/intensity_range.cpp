// SPDX-License-Identifier: BSD-3-Clause
#include "intensity_range.hpp"

#include <bit>
#include <cstdint>

namespace web_view {

void IntensityRange::add(float intensity) {
  if (!(intensity >= 0)) return;
  // The bits of positive floats are in the order of their values; + 0 makes 0 of -0.
  ++counts_[std::bit_cast<std::uint32_t>(intensity + 0.0f) >> 16];
  ++total_;
}

std::pair<float, float> IntensityRange::range() const {
  const auto percentile = [&](double share) {
    std::size_t left = std::size_t(share * double(total_));
    for (std::size_t bin = 0; bin < counts_.size(); ++bin) {
      if (left < counts_[bin]) return std::bit_cast<float>(std::uint32_t(bin) << 16);
      left -= counts_[bin];
    }
    return 0.0f;
  };
  return {percentile(0.01), percentile(0.99)};
}

}  // namespace web_view
