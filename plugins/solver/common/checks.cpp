// SPDX-License-Identifier: BSD-3-Clause
#include "common/checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cambium/error.hpp"
#include "common/information.hpp"
#include "common/short_list.hpp"

namespace cambium::pose_solver {
namespace {

void require(bool ok, const std::string& factor, const std::string& what) {
  if (!ok) throw Error(ErrorCode::numeric, factor, what);
}

/// Collects what was repaired, so that a file with ten thousand bad matrices gives one warning.
class Repairs {
 public:
  template <class Information>
  void repair(Information& information, const std::string& label) {
    require(information.allFinite(), label, "the information matrix is not finite");
    constexpr int n = Information::RowsAtCompileTime;
    Eigen::Matrix<double, n, n> symmetric = information;
    const Spectrum found = project_to_psd(symmetric);
    information = symmetric;
    if (found.negative < 0)
      replaced_.add(fmt::format("{}: smallest eigenvalue {:.3g}", label, found.negative));
    else if (found.singular)
      singular_.add(label);
  }
  void report(const Context& context) const {
    if (replaced_.count() > 0)
      context.warn(fmt::format(
          "{} information matrices have a negative eigenvalue; they were replaced by the nearest "
          "positive semi-definite matrix (check the order and the sign of the terms):{}",
          replaced_.count(), replaced_.text()));
    if (singular_.count() > 0)
      context.warn(
          fmt::format("{} information matrices are singular; they leave a direction of "
                      "their poses to other factors:{}",
                      singular_.count(), singular_.text()));
  }

 private:
  ShortList replaced_, singular_;
};

std::string name(const std::string& label, const char* kind, std::size_t k) {
  return label.empty() ? fmt::format("{} {}", kind, k) : label;
}

/// Files give quaternions to six digits; the factors expect norm 1.
void normalize(SE3& T, const std::string& label, const std::string& what) {
  require(T.finite() && T.q.norm() > 1e-6, label, what + " is not finite or has no rotation");
  T.q.normalize();
}

void check_poses(PoseGraph& graph) {
  require(graph.fixed.size() == graph.T_map_node.size(), "",
          fmt::format("the graph has {} poses but {} fixed flags", graph.T_map_node.size(),
                      graph.fixed.size()));
  for (std::size_t i = 0; i < graph.T_map_node.size(); ++i)
    normalize(graph.T_map_node[i],
              fmt::format("node {}", i < graph.ids.size() ? graph.ids[i] : NodeId(i)),
              "the initial pose");
}

void check_attitude(const PoseGraph& graph) {
  for (std::size_t k = 0; k < graph.attitude.size(); ++k) {
    const auto& f = graph.attitude[k];
    const bool ok = f.node < graph.T_map_node.size() && f.up_node.allFinite() &&
                    std::isfinite(f.sigma) && f.sigma > 0;
    require(ok, name("", "attitude factor", k),
            fmt::format("expected a node of the graph, a finite direction and sigma > 0, found "
                        "node {}, sigma {}",
                        f.node, f.sigma));
  }
}

}  // namespace

PoseGraph checked(const PoseGraph& graph, const Context& context) {
  PoseGraph out = graph;
  check_poses(out);
  const std::size_t n = graph.T_map_node.size();
  const auto require_node = [n](std::size_t node, const std::string& label) {
    require(node < n, label, "the factor names a node that the graph does not have");
  };
  Repairs repairs;
  for (std::size_t k = 0; k < out.relative.size(); ++k) {
    auto& f = out.relative[k];
    f.label = name(f.label, "relative factor", k);
    require_node(std::max(f.tail, f.head), f.label);
    normalize(f.T_tail_head, f.label, "the transform");
    repairs.repair(f.information, f.label);
  }
  for (std::size_t k = 0; k < out.priors.size(); ++k) {
    auto& f = out.priors[k];
    f.label = name(f.label, "prior", k);
    require_node(f.node, f.label);
    normalize(f.T_map_node, f.label, "the pose");
    repairs.repair(f.information, f.label);
  }
  for (std::size_t k = 0; k < out.positions.size(); ++k) {
    auto& f = out.positions[k];
    f.label = name(f.label, "position factor", k);
    require_node(f.node, f.label);
    require(f.t_map.allFinite(), f.label, "the position is not finite");
    repairs.repair(f.information, f.label);
  }
  check_attitude(out);
  repairs.report(context);
  return out;
}

std::vector<bool> held_nodes(const PoseGraph& graph, const std::vector<std::size_t>& component) {
  std::vector<bool> held = graph.fixed;
  std::vector<bool> tied(component.size());  // by component; there are no more of them than nodes
  for (std::size_t i = 0; i < held.size(); ++i)
    if (held[i]) tied[component[i]] = true;
  for (const auto& f : graph.priors) tied[component[f.node]] = true;
  for (const auto& f : graph.positions) tied[component[f.node]] = true;
  for (const auto& f : graph.attitude) tied[component[f.node]] = true;
  for (std::size_t i = 0; i < held.size(); ++i) {
    if (tied[component[i]]) continue;
    held[i] = tied[component[i]] = true;
  }
  return held;
}

}  // namespace cambium::pose_solver
