// SPDX-License-Identifier: BSD-3-Clause
#include "common/calibration.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "common/cholesky.hpp"
#include "common/jacobians.hpp"
#include "common/normal_equations.hpp"

namespace cambium::pose_solver {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;

/// Draws errors of the poses as the graph lets them be, from N(0, H^-1).
class Errors {
 public:
  Errors(const Problem& problem, const std::vector<SE3>& T_map_node, const Weights& weights,
         const Loss& loss)
      : equations_(problem.graph, problem.elimination),
        cholesky_(problem.elimination, 6, equations_.H().pattern()) {
    equations_.linearize(T_map_node, weights, loss);
    regular_ = cholesky_.factorize(equations_.H().values().data());
  }
  bool regular() const { return regular_; }

  /// One a column.
  Eigen::MatrixXd draw(int count) {
    Eigen::MatrixXd signs(6 * equations_.H().blocks(), count);
    for (double& s : signs.reshaped()) s = engine_() & 1 ? 1.0 : -1.0;
    return cholesky_.draw(signs);
  }

 private:
  NormalEquations equations_;
  Cholesky cholesky_;
  bool regular_ = false;
  std::mt19937_64 engine_{1979};
};

/// Of the rows of a kind in a group.
struct Sums {
  double rows = 0, squares = 0, explained = 0;  ///< r' Omega r, and how much of it poses take up
  double redundancy() const { return rows - explained; }
};

struct GroupSums {
  Sums translation, rotation;
};

Vector6 step_of(const Elimination& elimination, std::size_t node, const Eigen::MatrixXd& errors,
                Eigen::Index draw) {
  const int place = elimination.place(node);
  return place < 0 ? Vector6(Vector6::Zero()) : Vector6(errors.block<6, 1>(6 * place, draw));
}

/// Adds d' Omega d of a residual or of a change of it, by the diagonal blocks of the information.
void add_squares(const RelativeFactor& f, const Vector6& d, double share, double& translation,
                 double& rotation) {
  const Eigen::Matrix3d t = f.information.topLeftCorner<3, 3>(),
                        q = f.information.bottomRightCorner<3, 3>();
  translation += share * d.head<3>().dot(t * d.head<3>());
  rotation += share * d.tail<3>().dot(q * d.tail<3>());
}

/// A group at these poses.
class Linearised {
 public:
  Linearised(const OdometryGroup& group, const Problem& problem, const std::vector<SE3>& T_map_node)
      : elimination_(problem.elimination) {
    for (const std::size_t k : group.factors) {
      const RelativeFactor& f = problem.graph.relative[k];
      const Vector6 r = residual(f.T_tail_head, T_map_node[f.tail], T_map_node[f.head]);
      factors_.push_back(
          {&f, Jacobians(f.T_tail_head, T_map_node[f.tail].rotation().transpose(), r)});
      add_squares(f, r, 1, sums_.translation.squares, sums_.rotation.squares);
    }
    sums_.translation.rows = sums_.rotation.rows = 3 * double(factors_.size());
  }

  /// `share` of what each of the errors changes in the residuals is explained.
  void explain(const Eigen::MatrixXd& errors, double share) {
    for (const auto& [f, J] : factors_)
      for (Eigen::Index i = 0; i < errors.cols(); ++i) {
        const Vector6 dr = J.tail * step_of(elimination_, f->tail, errors, i) +
                           J.head * step_of(elimination_, f->head, errors, i);
        add_squares(*f, dr, share, sums_.translation.explained, sums_.rotation.explained);
      }
  }

  const GroupSums& sums() const { return sums_; }

 private:
  const Elimination& elimination_;
  std::vector<std::pair<const RelativeFactor*, Jacobians>> factors_;
  GroupSums sums_;
};

std::vector<Linearised> explained(const std::vector<OdometryGroup>& groups, const Problem& problem,
                                  const std::vector<SE3>& T_map_node, Errors& errors) {
  // What n poses explain is known to a share of 1 / sqrt(3 n draws).
  constexpr int batch = 16;
  const int batches = std::clamp(20000 / int(T_map_node.size()), 1, 16);
  std::vector<Linearised> out;
  for (const OdometryGroup& group : groups) out.emplace_back(group, problem, T_map_node);
  for (int i = 0; i < batches; ++i) {
    const Eigen::MatrixXd drawn = errors.draw(batch);
    for (Linearised& group : out) group.explain(drawn, 1.0 / (batches * batch));
  }
  return out;
}

/// By how much the sigma changes.
double change(const Sums& sums, SigmaScale& scale) {
  constexpr double least_redundancy = 20;  // numbers that say something: sigma to 15 %
  constexpr double most = 10;              // in one step
  scale.known = sums.redundancy() >= least_redundancy;
  if (!scale.known) return 1;
  const double out = std::clamp(std::sqrt(sums.squares / sums.redundancy()), 1 / most, most);
  scale.factor *= out;
  return out;
}

void rescale(RelativeFactor& factor, double translation, double rotation) {
  Vec6 scale;
  scale << Vec3::Constant(1 / translation), Vec3::Constant(1 / rotation);
  factor.information = scale.asDiagonal() * factor.information * scale.asDiagonal();
}

}  // namespace

std::vector<OdometryGroup> odometry_groups(const PoseGraph& graph) {
  PoseGraph trusted;
  trusted.T_map_node = graph.T_map_node;
  for (const RelativeFactor& f : graph.relative)
    if (!f.robust) trusted.relative.push_back(f);
  const auto component = components(trusted);
  std::map<std::size_t, OdometryGroup> groups;
  for (std::size_t k = 0; k < graph.relative.size(); ++k)
    if (const auto& f = graph.relative[k]; !f.robust) {
      const auto [it, is_new] = groups.try_emplace(component[f.tail]);
      it->second.first_node =
          is_new ? std::min(f.tail, f.head) : std::min({it->second.first_node, f.tail, f.head});
      it->second.factors.push_back(k);
    }
  std::vector<OdometryGroup> out;
  for (auto& [c, group] : groups) out.push_back(std::move(group));
  return out;
}

double calibrate(Problem& problem, const std::vector<SE3>& T_map_node, const Weights& weights,
                 const Loss& loss, std::vector<OdometryGroup>& groups) {
  Errors errors(problem, T_map_node, weights, loss);
  if (!errors.regular()) return 1;
  const auto linearised = explained(groups, problem, T_map_node, errors);
  double largest = 1;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const GroupSums& sums = linearised[g].sums();
    const double translation = change(sums.translation, groups[g].translation),
                 rotation = change(sums.rotation, groups[g].rotation);
    for (const std::size_t k : groups[g].factors)
      rescale(problem.graph.relative[k], translation, rotation);
    for (const double by : {translation, rotation}) largest = std::max({largest, by, 1 / by});
  }
  return largest;
}

}  // namespace cambium::pose_solver
