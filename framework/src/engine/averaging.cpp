// SPDX-License-Identifier: BSD-3-Clause
#include "engine/averaging.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace cambium {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

// What a pair without a say counts: enough to keep the equations regular, too little to show.
constexpr double floor_weight = 1e-9;

/// Which bodies hang together.
class Parts {
 public:
  explicit Parts(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), std::uint32_t(0));
  }
  std::uint32_t root(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  /// False when they were together already. The smaller number stays the root.
  bool join(std::uint32_t a, std::uint32_t b) {
    a = root(a), b = root(b);
    if (a == b) return false;
    parent_[std::max(a, b)] = std::min(a, b);
    return true;
  }

 private:
  std::vector<std::uint32_t> parent_;
};

/// The linear problems. Roots are held at the identity.
class Relaxation {
 public:
  Relaxation(std::size_t bodies, const std::vector<BodyPair>& pairs, BodyFrames& frames)
      : bodies_(bodies), pairs_(pairs), frames_(frames) {}

  void solve(const std::vector<double>& weight) {
    rotations(weight);
    translations(weight);
  }

 private:
  Index at(std::uint32_t body, Index size) const { return size * Index(body); }

  /// sum w tr((R_second - R_first R) S (...)'): the rows of all R are independent, so there is
  /// one matrix and three right-hand sides. Unknowns are transposed rotations, 3 x 3 blocks.
  void rotations(const std::vector<double>& weight) {
    MatrixXd A = MatrixXd::Zero(3 * Index(bodies_), 3 * Index(bodies_));
    MatrixXd B = MatrixXd::Zero(3 * Index(bodies_), 3);
    for (std::size_t k = 0; k < pairs_.size(); ++k) {
      const BodyPair& p = pairs_[k];
      const Eigen::Matrix3d R = p.fit.T_first_second.rotation(), S = weight[k] * p.fit.scatter;
      const Index a = at(p.first, 3), b = at(p.second, 3);
      A.block<3, 3>(a, a) += R * S * R.transpose();
      A.block<3, 3>(b, b) += S;
      A.block<3, 3>(a, b) -= R * S;
      A.block<3, 3>(b, a) -= S * R.transpose();
    }
    hold_roots(3, A, B, MatrixXd::Identity(3, 3));
    const MatrixXd X = A.ldlt().solve(B);
    for (std::uint32_t i = 0; i < bodies_; ++i)
      if (frames_.root[i] != i) {
        Mat4 T = Mat4::Identity();
        T.topLeftCorner<3, 3>() = X.block<3, 3>(at(i, 3), 0).transpose();
        frames_.T_root_body[i].q = SE3::from_matrix(T).q;  // the nearest rotation
      }
  }

  /// sum w |t_first + R_first T c - t_second - R_second c|^2 for the centres c.
  void translations(const std::vector<double>& weight) {
    MatrixXd A = MatrixXd::Zero(Index(bodies_), Index(bodies_)), B = MatrixXd::Zero(A.rows(), 3);
    for (std::size_t k = 0; k < pairs_.size(); ++k) {
      const BodyPair& p = pairs_[k];
      const Vec3 step = frames_.T_root_body[p.first].q * (p.fit.T_first_second * p.fit.centre) -
                        frames_.T_root_body[p.second].q * p.fit.centre;
      const Index a = at(p.first, 1), b = at(p.second, 1);
      A(a, a) += weight[k], A(b, b) += weight[k];
      A(a, b) -= weight[k], A(b, a) -= weight[k];
      B.row(b) += weight[k] * step.transpose();
      B.row(a) -= weight[k] * step.transpose();
    }
    hold_roots(1, A, B, MatrixXd::Zero(1, 3));
    const MatrixXd X = A.ldlt().solve(B);
    for (std::uint32_t i = 0; i < bodies_; ++i)
      if (frames_.root[i] != i) frames_.T_root_body[i].t = X.row(Index(i)).transpose();
  }

  /// Takes the roots, whose value is known, out of the unknowns.
  void hold_roots(Index size, MatrixXd& A, MatrixXd& B, const MatrixXd& value) const {
    for (std::uint32_t i = 0; i < bodies_; ++i) {
      if (frames_.root[i] != i) continue;
      const Index at_root = at(i, size);
      B -= A.middleCols(at_root, size) * value;
      A.middleCols(at_root, size).setZero();
      A.middleRows(at_root, size).setZero();
      A.block(at_root, at_root, size, size).setIdentity();
      B.middleRows(at_root, size) = value;
    }
  }

  std::size_t bodies_;
  const std::vector<BodyPair>& pairs_;
  BodyFrames& frames_;
};

/// Graduated non-convexity around the relaxation.
class Robust {
 public:
  Robust(std::size_t bodies, std::vector<BodyPair>& pairs, BodyFrames& frames)
      : pairs_(pairs),
        frames_(frames),
        parts_(bodies),
        relaxation_(bodies, pairs, frames),
        say_(pairs.size(), 1.0) {}

  void solve() {
    solve_and_measure();
    double worst = 0;
    for (const BodyPair& p : pairs_) worst = std::max(worst, squared(p));
    // Twice the truncation: below, all pairs fit anyway.
    for (double mu = 1 / (2 * worst - 1); mu > 0 && mu < 1e6; mu *= 1.4) {
      for (std::size_t k = 0; k < pairs_.size(); ++k) say_[k] = say(squared(pairs_[k]), mu);
      solve_and_measure();
      if (std::ranges::all_of(say_, [](double s) { return s == 0 || s == 1; })) break;
    }
    decide();
  }

 private:
  static double squared(const BodyPair& p) { return (p.off / p.tolerance) * (p.off / p.tolerance); }

  /// The weight of a truncated quadratic at this stage (Yang et al., equation 14).
  static double say(double squared, double mu) {
    if (squared <= mu / (mu + 1)) return 1;
    if (squared >= (mu + 1) / mu) return 0;
    return std::sqrt(mu * (mu + 1) / squared) - mu;
  }

  void solve_and_measure() {
    std::vector<double> weight(pairs_.size());
    for (std::size_t k = 0; k < pairs_.size(); ++k)
      weight[k] = pairs_[k].weight * std::max(say_[k], floor_weight);
    relaxation_.solve(weight);
    for (BodyPair& p : pairs_)
      p.off =
          p.fit.distance(frames_.T_root_body[p.first].inverse() * frames_.T_root_body[p.second]);
  }

  /// What GNC left out may be needed to hold bodies together: then the heaviest stay.
  void decide() {
    std::vector<std::size_t> order(pairs_.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      const bool in_a = say_[a] > 0.5, in_b = say_[b] > 0.5;
      return in_a != in_b ? in_a : pairs_[a].weight > pairs_[b].weight;
    });
    for (const std::size_t k : order) {
      const bool needed = parts_.join(pairs_[k].first, pairs_[k].second);
      say_[k] = needed || say_[k] > 0.5 ? 1 : 0;
    }
    solve_and_measure();
    for (std::size_t k = 0; k < pairs_.size(); ++k)
      pairs_[k].used = say_[k] == 1 || pairs_[k].off <= pairs_[k].tolerance;
  }

  std::vector<BodyPair>& pairs_;
  BodyFrames& frames_;
  Parts parts_;
  Relaxation relaxation_;
  std::vector<double> say_;
};

}  // namespace

BodyFrames average_frames(std::size_t bodies, std::vector<BodyPair>& pairs) {
  BodyFrames frames{{}, std::vector<SE3>(bodies)};
  Parts parts(bodies);
  for (const BodyPair& p : pairs) parts.join(p.first, p.second);
  for (std::uint32_t i = 0; i < bodies; ++i) frames.root.push_back(parts.root(i));
  if (!pairs.empty()) Robust(bodies, pairs, frames).solve();
  return frames;
}

}  // namespace cambium
