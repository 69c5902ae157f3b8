// SPDX-License-Identifier: BSD-3-Clause
#include "engine/copies.hpp"

#include "support/support.hpp"

using namespace cambium;
using namespace cambium::testing;

namespace {

Mission walk(const std::string& name, double bend, int nodes = 10) {
  std::vector<SE3> poses{SE3{}};
  for (int i = 1; i < nodes; ++i) poses.push_back(poses.back() * SE3::from_yaw(bend, {2, 0, 0}));
  return make_mission(name, poses);
}

}  // namespace

TEST(Copies, ARenamedAndRenumberedMissionIsRefused) {
  const Mission a = walk("a", 0.1);
  Mission copy = a;
  copy.name = "copy";
  copy.platform_id = 7;
  for (Node& node : copy.nodes) node.id += 500;
  try {
    refuse_copies({a, walk("b", 0.2), copy});
    FAIL() << "expected a refusal";
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ErrorCode::data);
    EXPECT_NE(e.message().find("'a' and 'copy' are the same recording: 10 of"), std::string::npos)
        << e.what();
  }
}

TEST(Copies, APieceOfAMissionIsRefused) {
  Mission piece = walk("piece", 0.1);
  piece.nodes.erase(piece.nodes.begin(), piece.nodes.begin() + 6);
  EXPECT_THROW(refuse_copies({walk("a", 0.1), piece}), Error);
}

TEST(Copies, OtherRecordingsStay) {
  EXPECT_NO_THROW(refuse_copies({walk("a", 0.1), walk("b", 0.2)}));  // both start at the origin
  Mission later = walk("later", 0.1);
  for (Node& node : later.nodes) node.stamp->sec += 1000;
  EXPECT_NO_THROW(refuse_copies({walk("a", 0.1), later}));
  EXPECT_NO_THROW(refuse_copies({walk("a", 0.1, 1), walk("b", 0.1, 1)}));
}
