// SPDX-License-Identifier: BSD-3-Clause
// Precision and recall of the accepted loops, by the true distance between their nodes.
#include <algorithm>
#include <set>
#include <string>

#include "bins.hpp"
#include "cambium/plugin.hpp"
#include "cambium/truth.hpp"
#include "common/relative_error.hpp"

namespace loops {
namespace {

using namespace cambium;

/// An accepted loop beside the truth.
struct Judged {
  NodeRef tail, head;
  double baseline;               // true distance of the nodes [m]
  double translation, rotation;  // error [m], [deg]
  bool correct = false;
};

Judged judge(const Loop& loop, const SE3& T_world_tail, const SE3& T_world_head) {
  const SE3 T_tail_head = T_world_tail.inverse() * T_world_head;
  const auto error = evaluator::relative_error(T_tail_head, loop.T_tail_head);
  return {loop.tail, loop.head, T_tail_head.t.norm(), error.translation, error.rotation};
}

Metric count(const std::string& name, std::size_t value, Better better) {
  return {"loops." + name, double(value), "", better};
}

}  // namespace

class LoopEvaluator final : public Evaluator {
 public:
  void params(ParamVisitor& v) override {
    v("max_translation", max_translation_, "A loop is wrong beyond this error", above(0, "m"));
    v("max_rotation", max_rotation_, "A loop is wrong beyond this error", above(0, "deg"));
    v("bins", bins_, "Edges of the bins of true distance, ascending", at_least(0, "m"));
    v("max_time_difference", max_time_difference_, "Between a node and its true pose",
      at_least(0, "s"));
  }
  std::string check_params() const override {
    if (bins_.size() < 2 ||
        std::adjacent_find(bins_.begin(), bins_.end(), std::greater_equal<>()) != bins_.end())
      return "bins must be at least two ascending distances";
    return {};
  }

  std::vector<Metric> evaluate(const Atlas& atlas, const std::filesystem::path& reference,
                               const Context& context) const override {
    const Truth truth = read_truth(atlas, reference, max_time_difference_);
    truth.require_matches();
    std::vector<Judged> judged;
    std::size_t accepted = 0;
    for (const Loop& loop : atlas.loops) {
      if (loop.state != LoopState::accepted) continue;
      ++accepted;
      const auto &T_world_tail = truth.at(loop.tail), &T_world_head = truth.at(loop.head);
      if (!T_world_tail || !T_world_head) continue;
      judged.push_back(judge(loop, *T_world_tail, *T_world_head));
      judged.back().correct =
          judged.back().translation <= max_translation_ && judged.back().rotation <= max_rotation_;
    }
    std::vector<Metric> metrics = summary(judged, accepted);
    precision_and_recall(truth, judged, context, metrics);
    ties(atlas, judged, metrics);
    return metrics;
  }

 private:
  static std::vector<Metric> summary(const std::vector<Judged>& judged, std::size_t accepted) {
    std::size_t correct = 0;
    double translation = 0, rotation = 0;
    for (const Judged& j : judged) {
      correct += j.correct;
      translation = std::max(translation, j.translation);
      rotation = std::max(rotation, j.rotation);
    }
    std::vector<Metric> metrics = {count("accepted", accepted, Better::neither),
                                   count("unjudged", accepted - judged.size(), Better::lower),
                                   count("wrong", judged.size() - correct, Better::lower)};
    if (judged.empty()) return metrics;  // no loops have no precision
    metrics.insert(metrics.begin(), {"loops.precision", double(correct) / double(judged.size()), "",
                                     Better::higher});
    metrics.push_back({"loops.worst_translation", translation, "m", Better::lower});
    metrics.push_back({"loops.worst_rotation", rotation, "deg", Better::lower});
    return metrics;
  }

  void precision_and_recall(const Truth& truth, const std::vector<Judged>& judged,
                            const Context& context, std::vector<Metric>& metrics) const {
    const Bins bins(bins_);
    std::vector<std::size_t> all(bins.size()), correct(bins.size()), tied(bins.size());
    std::set<std::pair<NodeRef, NodeRef>> found;  // a pair may hold several loops
    for (const Judged& j : judged) {
      const auto bin = bins.of(j.baseline);
      if (!bin) continue;
      ++all[*bin];
      correct[*bin] += j.correct;
      if (j.correct && j.tail.mission != j.head.mission)
        tied[*bin] += found.insert(std::minmax(j.tail, j.head)).second;
    }
    const auto close = close_pairs(truth, bins, context);
    for (std::size_t b = 0; b < bins.size(); ++b) {
      const std::string name = bins.name(b);
      if (all[b] > 0)
        metrics.push_back(
            {"loops.precision." + name, double(correct[b]) / double(all[b]), "", Better::higher});
      if (close[b] > 0)
        metrics.push_back(
            {"loops.recall." + name, double(tied[b]) / double(close[b]), "", Better::higher});
    }
  }

  /// How many nodes of each mission have a correct loop to each other mission.
  static void ties(const Atlas& atlas, const std::vector<Judged>& judged,
                   std::vector<Metric>& metrics) {
    std::set<std::pair<std::uint32_t, NodeRef>> tied;  // to a mission, a node of another
    for (const Judged& j : judged) {
      if (!j.correct || j.tail.mission == j.head.mission) continue;
      tied.insert({j.tail.mission, j.head});
      tied.insert({j.head.mission, j.tail});
    }
    for (std::uint32_t a = 0; a < atlas.missions.size(); ++a)
      for (std::uint32_t b = 0; b < atlas.missions.size(); ++b) {
        if (a == b) continue;
        const auto nodes = std::count_if(tied.begin(), tied.end(), [&](const auto& t) {
          return t.first == a && t.second.mission == b;
        });
        metrics.push_back(
            count("tied." + atlas.missions[a].mission->name + "." + atlas.missions[b].mission->name,
                  std::size_t(nodes), Better::higher));
      }
  }

  double max_translation_ = 0.5, max_rotation_ = 5.0;
  std::vector<double> bins_ = {0, 2, 5, 10, 15, 20, 30, 40};
  double max_time_difference_ = 0.01;
};

}  // namespace loops

CAMBIUM_PLUGIN("loops", "0.1.0") {
  registry.add<loops::LoopEvaluator>("loops", "Precision and recall of the accepted loops");
}
