// SPDX-License-Identifier: BSD-3-Clause
// Place recognition by a network that makes a descriptor of a bird's-eye picture.
#include <algorithm>

#include "cambium/files.hpp"
#include "cambium/plugin.hpp"
#include "common/density.hpp"
#include "common/levelled.hpp"
#include "network.hpp"

namespace learned_bev {

using namespace cambium;

class LearnedBev final : public PlaceRecognizer {
 public:
  void params(ParamVisitor& v) override {
    v("model", model_,
      "ONNX network, one picture in, one descriptor out; none: the small one inside",
      in_unit("file"));
    v("projection", projection_, "Rows and columns are rings and sectors, or y and x",
      one_of({"polar", "cartesian"}));
    v("rows", grid_.rows, "Of the picture; 32 for the network inside", between(1, 4096));
    v("cols", grid_.cols, "Of the picture; 64 for the network inside", between(1, 4096));
    v("max_range", grid_.max_range, "Radius of the picture, or half of its side", above(0.0, "m"));
    v("lowest", grid_.lowest, "Points farther below the base do not count", in_unit("m"));
    v("highest", grid_.highest, "Points farther above the base do not count", in_unit("m"));
    v("level", level_, "Set each cloud upright by the roll and pitch of its node first");
    v("candidates", candidates_, "At most so many proposals for a query", between(1, 10000));
    v("min_score", min_score_, "Pairs whose descriptors have a lower cosine are not proposed",
      between(-1.0, 1.0));
  }
  std::string check_params() const override {
    return grid_.lowest < grid_.highest ? "" : "lowest must be below highest";
  }
  // The network inside is made for it; what others do is not known.
  bool yaw_invariant() const override { return model_.empty() && projection_ == "polar"; }

  Fingerprints describe(const MissionView& mission, const Context& context) const override {
    columns::DensityGrid grid = grid_;
    grid.polar = projection_ == "polar";
    const Network network(model_.empty() ? std::string(small_network()) : read_file(model_),
                          model_.empty() ? "learned_bev's own network" : model_);
    const std::vector<float> blank(grid.size());
    Fingerprints out{mission.size(), network.run(blank, grid.rows, grid.cols).size(), {}, {}};
    out.table.resize(out.rows * out.cols, 0.0f);
    context.parallel_for(out.rows, [&](std::size_t i) {
      context.check_cancelled();
      float rotation[columns::rotation_size];
      const Cloud::Matrix3X points = columns::upright_points(mission, i, level_, rotation);
      std::vector<float> image(grid.size());
      columns::density_image(points, grid, image);
      if (std::ranges::max(image) <= 0) return;  // zeros are like nothing
      const std::vector<float> descriptor = network.run(image, grid.rows, grid.cols);
      std::ranges::copy(descriptor, out.table.begin() + long(i * out.cols));
    });
    return out;
  }

  std::vector<Candidate> match(const Fingerprints& query, const Fingerprints& reference,
                               const Pairing& pairing, const Context& context) const override {
    if (query.cols != reference.cols)
      throw Error(ErrorCode::config, "learned_bev",
                  "missions have descriptors of " + std::to_string(query.cols) + " and " +
                      std::to_string(reference.cols) +
                      " numbers; give all platforms the same model");
    std::vector<std::vector<Candidate>> found(query.rows);
    context.parallel_for(query.rows, [&](std::size_t q) {
      context.check_cancelled();
      found[q] = nearest(q, query, reference, pairing);
    });
    std::vector<Candidate> out;
    for (const auto& of_query : found) out.insert(out.end(), of_query.begin(), of_query.end());
    return out;
  }

 private:
  std::vector<Candidate> nearest(std::size_t q, const Fingerprints& query,
                                 const Fingerprints& reference, const Pairing& pairing) const {
    std::vector<Candidate> out;
    const auto a = Eigen::Map<const Eigen::VectorXf>(query.row(q).data(), long(query.cols));
    if (a.isZero(0)) return out;
    for (std::size_t r = 0; r < reference.rows; ++r) {
      const auto b = Eigen::Map<const Eigen::VectorXf>(reference.row(r).data(), long(query.cols));
      const double cosine = double(a.dot(b));
      if (cosine >= min_score_ && pairing.allowed(q, r) && !b.isZero(0))
        out.push_back({q, r, cosine, {}});
    }
    std::ranges::stable_sort(out, std::greater{}, &Candidate::score);
    out.resize(std::min(out.size(), std::size_t(candidates_)));
    return out;
  }

  std::string model_, projection_ = "polar";
  columns::DensityGrid grid_;
  bool level_ = true;
  int candidates_ = 5;
  double min_score_ = 0.0;
};

}  // namespace learned_bev

CAMBIUM_PLUGIN("learned_bev", "0.1.0") {
  registry.add<learned_bev::LearnedBev>(
      "learned_bev", "Descriptors that an ONNX network makes of bird's-eye pictures of density");
}
