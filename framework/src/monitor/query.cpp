// SPDX-License-Identifier: BSD-3-Clause
#include "monitor/query.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "cambium/error.hpp"
#include "cambium/fused.hpp"

namespace cambium::monitor {
namespace {

/// What a node saw of a region.
class Cropped final : public PayloadSource {
 public:
  Cropped(std::shared_ptr<const PayloadSource> whole, std::shared_ptr<const Region> region,
          const SE3& T_map_node, Digest key)
      : whole_(std::move(whole)), region_(std::move(region)), T_map_node_(T_map_node), key_(key) {}

  Payload load() const override {
    const Payload all = whole_->load();
    Payload out;
    if (all.cloud) {
      std::vector<std::size_t> inside;
      for (std::size_t i = 0; i < all.cloud->size(); ++i)
        if (region_->contains(T_map_node_ *
                              Vec3(all.cloud->points().col(Eigen::Index(i)).cast<double>())))
          inside.push_back(i);
      out.cloud = std::make_shared<const Cloud>(select(*all.cloud, inside));
    }
    if (all.trees) {
      std::vector<Tree> inside;
      for (const Tree& t : *all.trees)
        if (region_->contains(T_map_node_ * t.base)) inside.push_back(t);
      out.trees = std::make_shared<const std::vector<Tree>>(std::move(inside));
    }
    return out;
  }
  Digest digest() const override { return key_; }
  std::string where() const override { return whole_->where(); }

 private:
  std::shared_ptr<const PayloadSource> whole_;
  std::shared_ptr<const Region> region_;
  SE3 T_map_node_;
  Digest key_;
};

/// Where the nearest node is, for a place that none saw.
struct Nearest {
  double distance = std::numeric_limits<double>::infinity();
  std::string mission;
};

class Search {
 public:
  Search(const Survey& survey, const QueryOptions& options, const Context& context)
      : survey_(survey), options_(options), context_(context) {
    result_.cropped = survey.clouds;
    cropped_.resize(survey.clouds.missions.size());
    for (std::uint32_t m = 0; m < cropped_.size(); ++m)
      cropped_[m].resize(survey.clouds.missions[m].mission->nodes.size());
  }

  void look(std::uint32_t island, const GeoReference& g) {
    const auto region = std::make_shared<const Region>(options_.place, g);
    const auto missions = missions_in(survey_, island);
    std::vector<NodeRef> near;
    for (const std::uint32_t m : missions)
      for (std::uint32_t n = 0; n < cropped_[m].size(); ++n) {
        const double distance = region->distance(survey_.clouds.T_map_node({m, n}).t);
        const std::string& name = survey_.clouds.missions[m].mission->name;
        if (distance < nearest_.distance) nearest_ = {distance, name};
        if (distance <= options_.reach) near.push_back({m, n});
      }
    crop(near, region);
    add_nodes(near, *region);
    if (!survey_.has_trees || near.empty()) return;
    for (Stem& stem : stems_of(only(near), missions, options_.stems, context_))
      if (region->contains(stem.base)) result_.stems.push_back({island, std::move(stem)});
  }

  QueryResult finish() {
    if (result_.nodes.empty() && result_.stems.empty())
      throw Error(ErrorCode::check, survey_.name,
                  fmt::format("no mission saw this place; the nearest node is {:.0f} m from it (of "
                              "'{}')",
                              nearest_.distance, nearest_.mission));
    std::sort(result_.nodes.begin(), result_.nodes.end(),
              [](const SeenNode& a, const SeenNode& b) { return a.node < b.node; });
    result_.cropped.payloads = std::make_shared<const PayloadSources>(std::move(cropped_));
    return std::move(result_);
  }

 private:
  void crop(const std::vector<NodeRef>& near, const std::shared_ptr<const Region>& region) {
    for (const NodeRef& n : near)
      if (const auto& source = (*survey_.clouds.payloads)[n.mission][n.node]) {
        const Digest key = Hasher().add(source->digest()).add(region->digest()).digest();
        cropped_[n.mission][n.node] =
            std::make_shared<Cropped>(source, region, survey_.clouds.T_map_node(n), key);
      }
  }

  void add_nodes(const std::vector<NodeRef>& near, const Region& region) {
    std::vector<SeenNode> seen(near.size());
    context_.parallel_for(near.size(), [&](std::size_t i) {
      context_.check_cancelled();
      const NodeRef n = near[i];
      seen[i] = {n, region.contains(survey_.clouds.T_map_node(n).t), 0};
      const auto& source = cropped_[n.mission][n.node];
      const auto cloud = source ? source->load().cloud : nullptr;
      if (cloud) seen[i].points = cloud->size();
    });
    for (const SeenNode& s : seen)
      if (s.inside || s.points > 0) result_.nodes.push_back(s);
  }

  /// The trees that these nodes saw, whole: a tree at the edge has all its detections.
  Atlas only(const std::vector<NodeRef>& near) const {
    Atlas out = survey_.trees;
    PayloadSources sources(cropped_.size());
    for (std::size_t m = 0; m < cropped_.size(); ++m) sources[m].resize(cropped_[m].size());
    for (const NodeRef& n : near)
      sources[n.mission][n.node] = (*survey_.trees.payloads)[n.mission][n.node];
    out.payloads = std::make_shared<const PayloadSources>(std::move(sources));
    return out;
  }

  const Survey& survey_;
  const QueryOptions& options_;
  const Context& context_;
  QueryResult result_;
  PayloadSources cropped_;
  Nearest nearest_;
};

}  // namespace

QueryResult query(const Survey& survey, const QueryOptions& options, const Context& context) {
  Search search(survey, options, context);
  bool any = false;
  for (std::uint32_t i = 0; i < survey.clouds.islands.size(); ++i) {
    if (missions_in(survey, i).empty()) continue;
    const auto g = georeference(survey.clouds, survey.clouds.islands[i]);
    if (!g) {
      context.warn(
          fmt::format("island {} (mission '{}') has no georeference and is not searched", i,
                      survey.clouds.missions[missions_in(survey, i).front()].mission->name));
      continue;
    }
    any = true;
    search.look(i, *g);
  }
  if (!any)
    throw Error(ErrorCode::config, survey.name,
                "is not georeferenced, so that coordinates mean nothing in it; add a georeference "
                "step to its pipeline (docs/gnss.md) and run it again");
  return search.finish();
}

}  // namespace cambium::monitor
