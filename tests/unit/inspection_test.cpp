// SPDX-License-Identifier: BSD-3-Clause
// What `cambium inspect` finds.
#include "engine/inspection.hpp"

#include "cambium/dialect.hpp"
#include "support/support.hpp"

namespace cambium {
namespace {

void one_by_one(std::size_t n, const std::function<void(std::size_t)>& body) {
  for (std::size_t i = 0; i < n; ++i) body(i);
}

std::vector<SE3> line_of(int nodes) {
  std::vector<SE3> poses;
  for (int i = 0; i < nodes; ++i) poses.push_back({Quat::Identity(), Vec3(2.0 * i, 0, 0)});
  return poses;
}

bool finds(const Inspection& inspection, const std::string& part) {
  for (const auto& finding : inspection.findings)
    if (finding.find(part) != finding.npos) return true;
  return false;
}

class DamagedPayload final : public PayloadSource {
 public:
  Payload load() const override { throw Error(ErrorCode::data, "x.pcd", "is damaged"); }
  Digest digest() const override { return {}; }
  std::string where() const override { return "x.pcd"; }
};

TEST(Inspection, FiguresOfASoundMission) {
  const Inspection i = inspect(testing::make_mission("sound", line_of(5)), one_by_one);
  EXPECT_EQ(i.nodes, 5u);
  EXPECT_EQ(i.edges.at("odometry"), 4u);
  EXPECT_NEAR(i.path_length, 8, 1e-12);
  EXPECT_EQ(i.high, Vec3(8, 0, 0));
  EXPECT_EQ(i.parts, 1u);
  EXPECT_NEAR(i.largest_odometry_residual, 0, 1e-12);
  EXPECT_TRUE(i.findings.empty());
}

TEST(Inspection, GapsAndParts) {
  Mission m = testing::make_mission("gap", line_of(5));
  m.edges.erase(m.edges.begin() + 1);
  const Inspection i = inspect(m, one_by_one);
  EXPECT_EQ(i.parts, 2u);
  EXPECT_TRUE(finds(i, "falls into 2 parts"));
  EXPECT_TRUE(finds(i, "no edge ties the vertex to the one before it"));
}

TEST(Inspection, Stamps) {
  Mission m = testing::make_mission("stamps", line_of(4));
  m.nodes[1].stamp = m.nodes[0].stamp;
  m.nodes[3].stamp = Stamp{m.nodes[2].stamp->sec - 1, 5};
  const Inspection i = inspect(m, one_by_one);
  EXPECT_TRUE(finds(i, "the stamp is that of another vertex"));
  EXPECT_TRUE(finds(i, "goes back in time"));
}

TEST(Inspection, SingularInformation) {
  const Mission m = parse_g2o(
      "VERTEX_SE3:QUAT 0 0 0 0 0 0 0 1\nVERTEX_SE3:QUAT 1 1 0 0 0 0 0 1\n"
      "EDGE_SE3:QUAT 0 1 1 0 0 0 0 0 1 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 0 0 0 0 0 0\n",
      "g.g2o");
  const Inspection i = inspect(m, one_by_one);
  EXPECT_TRUE(finds(i, "g.g2o:3: the information is singular"));
}

TEST(Inspection, Payloads) {
  Mission m = testing::make_mission("payloads", line_of(4));
  m.nodes[0].payload = testing::in_memory(Cloud{{3, 4, 0, 1, 0, 0}, {}, {}});
  m.nodes[1].payload = testing::in_memory(Cloud{});
  m.nodes[2].payload = std::make_shared<DamagedPayload>();
  const Inspection i = inspect(m, one_by_one);
  EXPECT_EQ(i.payloads.clouds, 2u);
  EXPECT_EQ(i.payloads.empty_clouds, 1u);
  EXPECT_EQ(i.payloads.most_points, 2u);
  EXPECT_NEAR(i.payloads.farthest_point, 5, 1e-6);
  EXPECT_EQ(i.payloads.unreadable, 1u);
  EXPECT_TRUE(finds(i, "x.pcd: is damaged"));
}

TEST(Inspection, FixesOfAnotherTime) {
  Mission m = testing::make_mission("fixes", line_of(3));
  GnssFix fix;
  fix.stamp.sec = m.nodes[2].stamp->sec + 1000;
  m.fixes.push_back(fix);
  EXPECT_TRUE(finds(inspect(m, one_by_one), "of different times"));
}

}  // namespace
}  // namespace cambium
