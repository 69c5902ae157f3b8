// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "common/coarse_to_fine.hpp"

namespace cambium::registration {

/// Methods that start near the guess of the recogniser or of the map.
class NearGuess : public CoarseToFine {
 public:
  void params(ParamVisitor& v) override;

 private:
  std::vector<SE3> starts(const PreparedCloud& target, const PreparedCloud& source,
                          const SE3& guess) const override;

  double search_radius_ = 10.0;
  double search_height_ = 1.0;
  double search_yaw_ = 0.1;
  double search_step_ = 1.0;
  int hypotheses_ = 3;
};

}  // namespace cambium::registration
