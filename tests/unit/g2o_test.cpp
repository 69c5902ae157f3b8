// SPDX-License-Identifier: BSD-3-Clause
// The g2o dialect: every kind of line, and round trips.
#include <sstream>

#include "cambium/dialect.hpp"
#include "cambium/files.hpp"
#include "support/support.hpp"

namespace cambium {
namespace {

const std::string two_nodes =
    "VERTEX_SE3:QUAT_TIME 0 0 0 0 0 0 0 1 100 5\n"
    "VERTEX_SE3:QUAT_TIME 1 1 0 0 0 0 0 1 101 6\n";

Mission parse(const std::string& text) { return parse_g2o(text, "graph.g2o"); }

std::string written(const Mission& mission) {
  std::ostringstream out;
  write_g2o(out, mission);
  return out.str();
}

/// 1..21 as the upper triangle of a matrix that is positive definite.
const std::string information = " 100 1 2 3 4 5 101 6 7 8 9 102 10 11 12 103 13 14 104 15 105";

TEST(G2o, EdgeInformationIsUpperTriangularTranslationFirst) {
  const Mission m = parse(
      "VERTEX_SE3:QUAT 1054 0 0 0 0 0 0 1\nVERTEX_SE3:QUAT 1055 0 0 0 0 0 0 1\n"
      "EDGE_SE3:QUAT 1054 1055 0.251779 0.0571828 0.0217246 -0.0167946 -0.0087881 -0.0277189 "
      "0.999436 0 10 20 30 40 50 1 21 31 41 51 2 32 42 52 3 43 53 4 54 5");
  ASSERT_EQ(m.edges.size(), 1u);
  const Mat6& I = m.edges[0].information;
  for (int i = 0; i < 6; ++i) EXPECT_EQ(I(i, i), i);
  EXPECT_EQ(I(0, 5), 50);
  EXPECT_EQ(I(2, 4), 42);
  EXPECT_EQ(I(4, 5), 54);
  EXPECT_EQ(I, Mat6(I.transpose()));
  EXPECT_EQ(m.edges[0].kind, EdgeKind::odometry);
  EXPECT_EQ(m.edges[0].T_tail_head.t, Vec3(0.251779, 0.0571828, 0.0217246));
  EXPECT_EQ(m.edges[0].T_tail_head.q.w(), 0.999436);
  EXPECT_EQ(m.edges[0].T_tail_head.q.x(), -0.0167946);
}

TEST(G2o, VertexKindsAndStamps) {
  const Mission m = parse(
      "VERTEX_SE3:QUAT_TIME 7 1 2 3 0 0 0 1 1583840261 39995392\n"
      "VERTEX_SE3_SE3:QUAT_TIME 3 4 5 6 0 0 0 1 12 999999999\n"
      "VERTEX_SE3:QUAT 5 7 8 9 1 0 0 0\n");
  ASSERT_EQ(m.nodes.size(), 3u);
  EXPECT_EQ(m.nodes[0].id, 3);  // in order of their ids
  EXPECT_EQ(m.nodes[0].line, 2);
  EXPECT_EQ(m.nodes[0].stamp, (Stamp{12, 999999999}));
  EXPECT_FALSE(m.nodes[1].stamp);
  EXPECT_EQ(m.nodes[1].T_mission_node.q.x(), 1);
  EXPECT_EQ(m.nodes[2].stamp, (Stamp{1583840261, 39995392}));
  EXPECT_EQ(m.index_of(7), std::optional<std::size_t>(2));
  EXPECT_EQ(m.name, "graph");
}

TEST(G2o, OdometryMayRunBackwardsWhenAllOfItDoes) {
  const std::string three = two_nodes + "VERTEX_SE3:QUAT 2 0 0 0 0 0 0 1\n";
  const std::string back = "EDGE_SE3:QUAT 1 0 0 0 0 0 0 0 1" + information + "\n";
  const std::string far = "EDGE_SE3:QUAT 2 0 0 0 0 0 0 0 1" + information + "\n";
  const Mission all = parse(three + back + far);
  EXPECT_EQ(all.edges[0].kind, EdgeKind::odometry);
  EXPECT_EQ(all.edges[0].tail, 1);
  EXPECT_EQ(all.edges[1].kind, EdgeKind::loop);
  ASSERT_EQ(all.warnings.size(), 1u);
  EXPECT_NE(all.warnings[0].find("it is taken for odometry"), std::string::npos);

  const Mission mixed =
      parse(three + back + "EDGE_SE3:QUAT 1 2 0 0 0 0 0 0 1" + information + "\n");
  EXPECT_EQ(mixed.edges[0].kind, EdgeKind::loop);
  EXPECT_EQ(mixed.edges[1].kind, EdgeKind::odometry);
}

TEST(G2o, EdgeKinds) {
  const Mission m = parse(
      "EDGE_SE3:QUAT 1 2 0 0 0 0 0 0 1" + information + "\n" +  // before its vertices
      two_nodes + "VERTEX_SE3:QUAT 2 0 0 0 0 0 0 1\n" + "EDGE_SE3:QUAT 2 0 0 0 0 0 0 0 1" +
      information + "\n" + "EDGE_SE3:QUAT 1 1 5 6 7 0 0 0 1" + information + "\n" +
      "EDGE_SE3_SWITCHABLE 0 2 17 1 0 0 0 0 0 1" + information + "\n" +
      "EDGE_SE3_MAXMIX 0 2 0.01 1 0 0 0 0 0 1" + information + "\n" +
      "EDGE_SE3_PRIOR 1 0 5 6 7 0 0 0 1" + information + "\n" + "EDGE_SE3_PRIOR 1 5 6 7 0 0 0 1" +
      information + "\n" + "EDGE_SE3_PRIORXYZ 2 5 6 7  66 1 2 67 3 68\n");
  ASSERT_EQ(m.edges.size(), 8u);
  const EdgeKind kinds[] = {EdgeKind::odometry, EdgeKind::loop,    EdgeKind::prior,
                            EdgeKind::loop,     EdgeKind::loop,    EdgeKind::prior,
                            EdgeKind::prior,    EdgeKind::position};
  for (int k = 0; k < 8; ++k) EXPECT_EQ(m.edges[k].kind, kinds[k]) << k;
  EXPECT_EQ(m.edges[3].extra, "17");
  EXPECT_EQ(m.edges[4].extra, "0.01");
  EXPECT_EQ(m.edges[6].T_tail_head.t, Vec3(5, 6, 7));
  EXPECT_EQ(m.edges[7].T_tail_head.t, Vec3(5, 6, 7));
  EXPECT_EQ(m.edges[7].information(1, 2), 3);
  EXPECT_EQ(m.edges[7].information(0, 2), 2);
  EXPECT_EQ(m.edges[0].line, 1);
  const Mission again = parse(written(m));
  for (int k = 0; k < 8; ++k) {
    EXPECT_EQ(again.edges[k].kind, kinds[k]) << k;
    EXPECT_EQ(again.edges[k].tag, m.edges[k].tag) << k;
    EXPECT_EQ(again.edges[k].extra, m.edges[k].extra) << k;
  }
}

TEST(G2o, EdgesWithoutInformationGetIdentityAndOneWarning) {
  const Mission m =
      parse(two_nodes + "EDGE_SE3:QUAT 0 1 1 0 0 0 0 0 1\nEDGE_SE3:QUAT 1 0 1 0 0 0 0 0 1\n");
  ASSERT_EQ(m.edges.size(), 2u);
  EXPECT_EQ(m.edges[0].information, Mat6(Mat6::Identity()));
  ASSERT_EQ(m.warnings.size(), 1u);
  EXPECT_EQ(m.warnings[0],
            "graph.g2o:3: EDGE_SE3:QUAT without information; identity was taken (2 such lines)");
}

TEST(G2o, MissionLines) {
  const Mission m = parse(two_nodes +
                          "PLATFORM_ID 2\nGNSS_LLA_REF 61.2 25.1 130.5\n"
                          "GNSS_LLA_TO_MAP 1 2 3 0 0 0.6 0.8\nFIX 0 1\n");
  EXPECT_EQ(m.platform_id, 2);
  ASSERT_TRUE(m.georeference);
  EXPECT_EQ(m.georeference->latitude, 61.2);
  EXPECT_EQ(m.georeference->T_map_enu.t, Vec3(1, 2, 3));
  EXPECT_EQ(m.georeference->T_map_enu.q.w(), 0.8);
  EXPECT_TRUE(m.nodes[0].fixed && m.nodes[1].fixed);
  EXPECT_TRUE(m.warnings.empty());
}

TEST(G2o, HalfAGeoreferenceIsKeptWithAWarning) {
  const Mission m = parse(two_nodes + "GNSS_LLA_REF 61.2 25.1 130.5\n");
  EXPECT_FALSE(m.georeference);
  ASSERT_EQ(m.unknown_lines.size(), 1u);
  EXPECT_EQ(m.warnings.size(), 1u);
}

TEST(G2o, UnknownLinesAreKeptInOrder) {
  const Mission m = parse("# VERTEX_SE3:QUAT_TIME id x y z qx qy qz qw sec nsec\n#no blank\n" +
                          two_nodes + "TAG_DETECTION 1 2  3\nPAIR 0 1\r\nTAG_DETECTION 4\n");
  ASSERT_EQ(m.unknown_lines.size(), 5u);
  EXPECT_EQ(m.unknown_lines[2].text, "TAG_DETECTION 1 2  3");
  EXPECT_EQ(m.unknown_lines[3].text, "PAIR 0 1");
  EXPECT_EQ(m.unknown_lines[3].line, 6);
  EXPECT_EQ(m.warnings.size(), 2u);  // one a tag, none for comments
  EXPECT_NE(written(m).find("#no blank\nTAG_DETECTION 1 2  3\nPAIR 0 1\n"), std::string::npos);
}

TEST(G2o, LineEndsAndBlanksDoNotMatter) {
  const Mission plain = parse(two_nodes);
  const Mission odd = parse(
      "\xEF\xBB\xBF  VERTEX_SE3:QUAT_TIME\t0 0 0 0  0 0 0 +1 100 5 \r\n\r\n"
      "VERTEX_SE3:QUAT_TIME 1 1.0 0e0 -0 0 0 0 1 101 6");
  EXPECT_EQ(odd.nodes.size(), 2u);
  EXPECT_EQ(odd.nodes[1].T_mission_node.t.x(), plain.nodes[1].T_mission_node.t.x());
  EXPECT_EQ(odd.nodes[1].stamp, plain.nodes[1].stamp);
}

// Found by fuzzing: a mark inside the file came to its beginning by writing, and changed its
// meaning.
TEST(G2o, ByteOrderMarksOfJoinedFilesAreNoPartOfTheText) {
  const Mission m = parse("# first\n\xEF\xBB\xBF# second\n" + two_nodes);
  EXPECT_EQ(m.unknown_lines[1].text, "# second");
}

TEST(G2o, IdsAboveTwoToTheThirtyTwo) {
  const Mission m = parse(
      "VERTEX_SE3:QUAT 6989586621679009792 0 0 0 0 0 0 1\n"
      "VERTEX_SE3:QUAT 6989586621679009793 0 0 0 0 0 0 1\n"
      "EDGE_SE3:QUAT 6989586621679009792 6989586621679009793 0 0 0 0 0 0 1\n");
  EXPECT_EQ(m.nodes[1].id, 6989586621679009793);
  EXPECT_EQ(m.edges[0].kind, EdgeKind::odometry);
}

TEST(G2o, EdgesToAnotherRobotsFileAreKept) {
  const Mission m = parse(
      "VERTEX_SE3:QUAT 6989586621679009792 0 0 0 0 0 0 1\n"
      "EDGE_SE3:QUAT 6989586621679009792 7061644215716937728 0 0 0 0 0 0 1" +
      information + "\n");
  EXPECT_TRUE(m.edges.empty());
  ASSERT_EQ(m.unknown_lines.size(), 1u);
  EXPECT_EQ(m.unknown_lines[0].line, 2);
  EXPECT_EQ(m.warnings.size(), 1u);
}

TEST(G2o, EveryNumberReadsBackBitForBit) {
  Mission m = parse(two_nodes + "EDGE_SE3:QUAT 0 1 1 0 0 0 0 0 1\n");
  m.nodes[0].T_mission_node.t = Vec3(0.1, -1.0 / 3.0, 4.9406564584124654e-324);
  m.nodes[1].T_mission_node.t = Vec3(1.7976931348623157e308, -0.0, 123456789.12345679);
  m.edges[0].information *= 2.0 / 3.0;
  const std::string text = written(m);
  const Mission again = parse(text);
  EXPECT_EQ(again.nodes[0].T_mission_node.t, m.nodes[0].T_mission_node.t);
  EXPECT_EQ(again.nodes[1].T_mission_node.t, m.nodes[1].T_mission_node.t);
  EXPECT_TRUE(std::signbit(again.nodes[1].T_mission_node.t.y()));
  EXPECT_EQ(again.edges[0].information, m.edges[0].information);
  EXPECT_EQ(written(again), text);
}

TEST(G2o, RoundedQuaternionsKeepTheirDigitsOthersAreNormalised) {
  const Mission rounded =
      parse("VERTEX_SE3:QUAT 0 0 0 0 0.0114295 -0.00805472 -0.703534 0.710524\n");
  EXPECT_EQ(rounded.nodes[0].T_mission_node.q.z(), -0.703534);
  EXPECT_TRUE(rounded.warnings.empty());
  const Mission off = parse("VERTEX_SE3:QUAT 0 0 0 0 0 0 0 2\n");
  EXPECT_EQ(off.nodes[0].T_mission_node.q.w(), 1);
  EXPECT_EQ(off.warnings.size(), 1u);
}

TEST(G2o, IndefiniteInformationWarnsWithItsLineSemidefiniteDoesNot) {
  const std::string edge = "EDGE_SE3:QUAT 0 1 1 0 0 0 0 0 1";
  const Mission bad = parse(two_nodes + edge + " 1 2 0 0 0 0 1 0 0 0 0 1 0 0 0 1 0 0 1 0 1\n");
  ASSERT_EQ(bad.warnings.size(), 1u);
  EXPECT_EQ(bad.warnings[0].rfind("graph.g2o:3: the information matrix is indefinite", 0), 0u);
  EXPECT_EQ(bad.edges[0].information(0, 1), 2);  // as it was written: solvers project
  const Mission flat = parse(two_nodes + edge + " 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 0 0 0 0 0 0\n");
  EXPECT_TRUE(flat.warnings.empty());
}

// The sensor's prior and the node's are the same function of the node's pose, to first order.
TEST(G2o, PriorWithSensorOffsetBecomesAPriorOfTheBase) {
  const Mission m = parse(two_nodes +
                          "PARAMS_SE3OFFSET 4 1 2 3 0 0.6 0 0.8\n"
                          "EDGE_SE3_PRIOR 1 4 10 20 30 0.6 0 0 0.8" +
                          information + "\n");
  const SE3 T_base_sensor{Quat(0.8, 0, 0.6, 0), Vec3(1, 2, 3)};
  const SE3 T_mission_sensor{Quat(0.8, 0.6, 0, 0), Vec3(10, 20, 30)};
  ASSERT_EQ(m.edges.size(), 1u);
  const Edge& edge = m.edges[0];
  EXPECT_LT((edge.T_tail_head * T_base_sensor * T_mission_sensor.inverse()).log().norm(), 1e-12);
  Mat6 Omega = Mat6::Zero();
  const double upper[] = {100, 1,  2,  3,  4,   5,  101, 6,   7,  8,  9,
                          102, 10, 11, 12, 103, 13, 14,  104, 15, 105};
  for (int r = 0, k = 0; r < 6; ++r)
    for (int c = r; c < 6; ++c) Omega(r, c) = Omega(c, r) = upper[k++];
  for (int axis = 0; axis < 6; ++axis) {
    const SE3 T_mission_node = edge.T_tail_head * SE3::exp(1e-6 * Vec6::Unit(axis));
    const Vec6 of_node = residual(edge.T_tail_head, SE3{}, T_mission_node);
    const Vec6 of_sensor = residual(T_mission_sensor, SE3{}, T_mission_node * T_base_sensor);
    const double expected = of_sensor.dot(Omega * of_sensor);
    EXPECT_NEAR(of_node.dot(edge.information * of_node), expected, 1e-5 * expected) << axis;
  }
  EXPECT_EQ(edge.information, Mat6(edge.information.transpose()));
  const std::string text = written(m);
  EXPECT_NE(text.find("PARAMS_SE3OFFSET 4"), std::string::npos);
  EXPECT_EQ(written(parse(text)), text);
}

TEST(G2o, DigestFollowsTheContentNotThePlace) {
  const Mission a = parse_g2o(two_nodes, "one/graph.g2o");
  const Mission b = parse_g2o("\n" + two_nodes, "two/graph.g2o");
  EXPECT_EQ(a.digest, b.digest);
  std::string moved = two_nodes;
  moved.replace(moved.find(" 101 6"), 6, " 101 7");
  EXPECT_NE(parse(moved).digest, a.digest);
  EXPECT_NE(parse(two_nodes + "# a word\n").digest, a.digest);
}

TEST(G2o, PublicGraphsParseAndRoundTrip) {
  int graphs = 0;
  for (const char* archive : {"pose_graphs", "gnss"}) {
    const auto folder = testing::real_data(archive);
    if (folder.empty()) GTEST_SKIP() << archive << " is not there";
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
      if (entry.path().extension() != ".g2o") continue;
      const Mission m = read_g2o(entry.path());
      const std::string text = written(m);
      const Mission again = parse_g2o(text, entry.path());
      EXPECT_EQ(again.digest, m.digest) << entry.path();
      EXPECT_EQ(written(again), text) << entry.path();
      ++graphs;
    }
  }
  EXPECT_GE(graphs, 15);
}

}  // namespace
}  // namespace cambium
