// SPDX-License-Identifier: BSD-3-Clause
// The one cost: the order of its terms, its invariances, and its components.
#include <cmath>

#include "cambium/pose_graph.hpp"
#include "support/support.hpp"

namespace cambium {
namespace {

Vec6 tangent(double x, double y, double z, double a, double b, double c) {
  Vec6 xi;
  xi << x, y, z, a, b, c;
  return xi;
}

const SE3 T_map_tail = SE3::exp(tangent(4, -2, 1, 0.3, -0.8, 1.9));
const SE3 T_tail_head = SE3::exp(tangent(1, 0.2, -0.1, -0.2, 0.1, 0.4));

PoseGraph two_nodes(const SE3& T_map_head) {
  PoseGraph g;
  g.T_map_node = {T_map_tail, T_map_head};
  g.ids = {0, 1};
  g.fixed = {true, false};
  g.relative.push_back({0, 1, T_tail_head, Mat6::Identity(), false, ""});
  return g;
}

TEST(Residual, IsZeroWhereTheMeasurementHolds) {
  EXPECT_LT(residual(T_tail_head, T_map_tail, T_map_tail * T_tail_head).norm(), 1e-14);
}

TEST(Residual, TranslationFirstInTheTailFrameThenTwiceTheVectorPart) {
  const SE3 off{Quat(std::cos(0.05), 0, std::sin(0.05), 0), Vec3::Zero()};
  SE3 T_map_head = T_map_tail * T_tail_head * off;
  T_map_head.t += T_map_tail.q * Vec3(0.1, 0.2, 0.3);
  const Vec6 expected = tangent(0.1, 0.2, 0.3, 0, 2 * std::sin(0.05), 0);
  EXPECT_LT((residual(T_tail_head, T_map_tail, T_map_head) - expected).norm(), 1e-14);
}

TEST(Residual, DoesNotSeeTheSignNorTheNormOfAQuaternion) {
  const SE3 T_map_head = T_map_tail * T_tail_head * SE3::exp(tangent(0.1, 0, 0, 2.0, 1.0, -1.5));
  const Vec6 r = residual(T_tail_head, T_map_tail, T_map_head);
  const auto scaled = [](SE3 T, double by) {
    T.q.coeffs() *= by;
    return T;
  };
  EXPECT_EQ(r, residual(scaled(T_tail_head, -1), T_map_tail, T_map_head));
  EXPECT_EQ(r, residual(T_tail_head, scaled(T_map_tail, -1), T_map_head));
  EXPECT_EQ(r, residual(T_tail_head, T_map_tail, scaled(T_map_head, -1)));
  EXPECT_LT((r - residual(scaled(T_tail_head, 1 + 1e-5), scaled(T_map_tail, 1 - 1e-5),
                          scaled(T_map_head, 1 + 1e-5)))
                .norm(),
            1e-14);
}

TEST(Residual, DoesNotSeeWhereTheMapFrameIs) {
  const SE3 T_map_head = T_map_tail * T_tail_head * SE3::exp(tangent(0.1, 0.2, 0.3, 0.1, 0, 0.2));
  const SE3 T_other_map = SE3::exp(tangent(30, -20, 10, 1, 2, -1));
  EXPECT_LT((residual(T_tail_head, T_map_tail, T_map_head) -
             residual(T_tail_head, T_other_map * T_map_tail, T_other_map * T_map_head))
                .norm(),
            1e-12);
}

TEST(Residual, KeepsItsDigitsInAMapOfUtmSize) {
  const Vec3 utm(5e5, 6.7e6, 100);
  const SE3 tail{T_map_tail.q, utm}, head{T_map_tail.q, utm + T_map_tail.q * Vec3(0.25, 0, 0)};
  const SE3 measured{Quat::Identity(), Vec3(0.25, 0, 0)};
  EXPECT_LT(residual(measured, tail, head).norm(), 2e-9);  // half a nanometre is one bit of 6.7e6
}

/// Golden: the terms of "EDGE_SE3:QUAT ... 0 10 20 30 40 50 1 21 31 41 51 2 ..." in their places.
TEST(Cost, TakesTheInformationTranslationFirst) {
  Mat6 information;
  const double terms[] = {0, 10, 20, 30, 40, 50, 1,  21, 31, 41, 51,
                          2, 32, 42, 52, 3,  43, 53, 4,  54, 5};
  const double* term = terms;
  for (int row = 0; row < 6; ++row)
    for (int col = row; col < 6; ++col) information(row, col) = information(col, row) = *term++;
  information.diagonal().array() += 200;  // positive definite
  PoseGraph g = two_nodes(T_map_tail * T_tail_head);
  g.relative[0].information = information;
  g.T_map_node[1].t += T_map_tail.q * Vec3(2, 0, 0);  // r = (2 0 0 0 0 2 sin(0.1))
  g.T_map_node[1].q = g.T_map_node[1].q * Quat(std::cos(0.1), 0, 0, std::sin(0.1));
  const double x = 2, c = 2 * std::sin(0.1);
  EXPECT_NEAR(cost(g, g.T_map_node), 200 * x * x + 2 * 50 * x * c + 205 * c * c, 1e-11);
}

TEST(Cost, IsNeverNegative) {
  PoseGraph g = two_nodes(T_map_tail * T_tail_head);
  g.relative[0].information(1, 1) = -4;
  g.T_map_node[1].t += T_map_tail.q * Vec3(3, 0.5, 0);
  EXPECT_NEAR(cost(g, g.T_map_node), 9, 1e-13);  // as if the term were 0
}

TEST(Cost, AddsEveryKindOfFactor) {
  PoseGraph g = two_nodes(T_map_tail * T_tail_head);
  g.T_map_node[1].t += T_map_tail.q * Vec3(0, 0.5, 0);
  EXPECT_NEAR(cost(g, g.T_map_node), 0.25, 1e-14);
  EXPECT_NEAR(cost(g, g.T_map_node, {0.5}), 0.125, 1e-14);

  g.priors.push_back({0, SE3{T_map_tail.q, T_map_tail.t - Vec3(2, 0, 0)}, Mat6::Identity(), ""});
  EXPECT_NEAR(cost(g, g.T_map_node), 0.25 + 4, 1e-13);

  Mat3 information = Mat3::Identity();
  information(2, 2) = 0.1;
  g.positions.push_back({0, T_map_tail.t + Vec3(1, 0, 10), information, true, ""});
  EXPECT_NEAR(cost(g, g.T_map_node), 0.25 + 4 + 1 + 10, 1e-13);

  const double tilt = 0.02, sigma = 0.01;
  const Vec3 up = T_map_tail.q.conjugate() * Vec3::UnitZ();
  const Vec3 axis = up.unitOrthogonal();
  g.attitude.push_back({0, Eigen::AngleAxisd(tilt, axis) * up, sigma});
  EXPECT_NEAR(cost(g, g.T_map_node), 15.25 + std::pow(std::sin(tilt) / sigma, 2), 1e-12);
}

TEST(Cost, AttitudeIsFreeOfYawAndPosition) {
  PoseGraph g;
  g.T_map_node = {T_map_tail};
  g.attitude.push_back({0, Vec3(0.1, 0.2, 1).normalized(), 0.05});
  const double F = cost(g, g.T_map_node);
  EXPECT_GT(F, 1);
  EXPECT_NEAR(cost(g, {SE3::from_yaw(2.1, Vec3(5, 6, 7)) * T_map_tail}), F, 1e-12 * F);
}

TEST(Components, AreNumberedByTheirFirstNode) {
  PoseGraph g;
  g.T_map_node.resize(7);
  for (const auto& [tail, head] : {std::pair{5, 1}, {6, 2}, {1, 3}, {3, 5}})
    g.relative.push_back({std::size_t(tail), std::size_t(head), {}, Mat6::Identity(), true, ""});
  EXPECT_EQ(components(g), (std::vector<std::size_t>{0, 1, 2, 1, 3, 1, 2}));
  EXPECT_TRUE(components(PoseGraph{}).empty());
}

}  // namespace
}  // namespace cambium
