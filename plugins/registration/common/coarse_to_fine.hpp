// SPDX-License-Identifier: BSD-3-Clause
// What gicp, icp_point_to_plane and ndt share: preparing a cloud once, finding starts, refining from a
// coarse to a fine cloud, and judging the result. A method brings `refine`.
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cambium/plugin.hpp"
#include "common/optimise.hpp"
#include "common/quality.hpp"
#include "common/search.hpp"

namespace cambium::registration {

/// One resolution of a prepared cloud.
struct Level {
  Surface surface;                    ///< as a target: all points
  Patches sample;                     ///< as a source: evenly fewer, since every one costs a search
  double spacing = 0;                 ///< of the sample along a surface [m]
  std::shared_ptr<const void> extra;  ///< the method's own
  std::size_t extra_bytes = 0;
};

struct PreparedCloud {
  Level coarse, fine;
};

class CoarseToFine : public Registration {
 public:
  void params(ParamVisitor& v) override;
  std::string check_params() const override;
  Prepared prepare(const Payload& payload, const Context& context) const override;
  Alignment align(const Prepared& target, const Prepared& source, const SE3& T_target_source_guess,
                  const Context& context) const override;

 protected:
  /// For methods that pair points: params() of such a method calls this too.
  void correspondence_params(ParamVisitor& v);
  /// T_target_source near the guess, or nothing when the optimiser gave up.
  virtual std::optional<SE3> refine(const Level& target, const Level& source, const SE3& guess,
                                    const Stage& stage) const = 0;
  /// Computes what the method wants per cloud besides the surface.
  virtual void extend(Level& /*level*/, double /*voxel_size*/) const {}

  double voxel_size_ = 0.4;
  double coarse_voxel_size_ = 1.0;
  int neighbours_ = 10;
  double max_correspondence_distance_ = 1.0;
  double coarse_correspondence_distance_ = 4.0;
  int max_iterations_ = 30;
  double translation_epsilon_ = 0.002;
  double rotation_epsilon_ = 0.0005;
  int source_points_ = 4000;

 private:
  Level make_level(const Thinned& cloud) const;
  std::optional<SE3> best_coarse(const PreparedCloud& target, const PreparedCloud& source,
                                 const SE3& guess, const Context& context) const;
  void judge(const Level& target, const Level& source, Alignment& alignment) const;

  double search_radius_ = 10.0;
  double search_height_ = 1.0;
  double search_yaw_ = 0.1;
  double search_step_ = 1.0;
  int hypotheses_ = 3;
  double overlap_distance_ = 0.5;
  double min_overlap_ = 0.5;
  double max_rmse_ = 0.2;
  int min_points_ = 100;
  double sigma_translation_floor_ = 0.03;
  double sigma_rotation_floor_ = 0.007;
  double correlation_length_ = 2.0;
};

}  // namespace cambium::registration
