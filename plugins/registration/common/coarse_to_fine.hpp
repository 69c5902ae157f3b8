// SPDX-License-Identifier: BSD-3-Clause
// What the registrations of clouds share: preparing a cloud once, refining starts from a coarse to
// a fine cloud, and judging the result. A method brings `starts` and `refine`.
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cambium/plugin.hpp"
#include "common/optimise.hpp"
#include "common/quality.hpp"
#include "common/range_image.hpp"

namespace cambium::registration {

/// One resolution of a prepared cloud.
struct Level {
  Surface surface;                    ///< as a target: all points
  Patches sample;                     ///< as a source: evenly fewer, since every one costs a search
  Patches probe;                      ///< still fewer, to judge a result
  double spacing = 0;                 ///< of the probe along a surface [m]
  std::shared_ptr<const void> extra;  ///< the method's own
  std::size_t extra_bytes = 0;
};

struct PreparedCloud {
  Level coarse, fine;
  RangeImage sight;
  std::shared_ptr<const void> extra;  ///< what `starts` needs
  std::size_t extra_bytes = 0;
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
  /// Distinct T_target_source to refine on the coarse clouds.
  virtual std::vector<SE3> starts(const PreparedCloud& target, const PreparedCloud& source,
                                  const SE3& guess) const = 0;
  /// T_target_source near the guess, or nothing when the optimiser gave up.
  virtual std::optional<SE3> refine(const Level& target, const Level& source, const SE3& guess,
                                    const Stage& stage) const = 0;
  /// Computes what the method wants per cloud besides the surface.
  virtual void extend(Level& /*level*/, double /*voxel_size*/) const {}
  virtual void extend(PreparedCloud& /*cloud*/) const {}

  double voxel_size_ = 0.4;
  double coarse_voxel_size_ = 1.0;
  int neighbours_ = 10;
  double max_correspondence_distance_ = 0.5;
  double coarse_correspondence_distance_ = 4.0;
  int max_iterations_ = 30;
  double translation_epsilon_ = 0.002;
  double rotation_epsilon_ = 0.0005;
  int source_points_ = 4000;
  double overlap_distance_ = 0.5;
  double min_overlap_ = 0.5;
  double max_rmse_ = 0.2;
  double max_seen_through_ = 1.0;  ///< off: foliage lets rays pass

 private:
  Level make_level(const Thinned& cloud, int source_points) const;
  std::optional<SE3> best_coarse(const PreparedCloud& target, const PreparedCloud& source,
                                 const SE3& guess, const Context& context) const;
  void judge(const PreparedCloud& target, const PreparedCloud& source, Alignment& alignment) const;

  int min_points_ = 100;
  NoiseModel noise_;
};

}  // namespace cambium::registration
