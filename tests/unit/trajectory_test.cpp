// SPDX-License-Identifier: BSD-3-Clause
// TUM trajectories.
#include "cambium/error.hpp"
#include "cambium/files.hpp"
#include "support/support.hpp"

namespace cambium {
namespace {

std::string refusal(const std::string& text) {
  try {
    parse_tum(text, "t.tum");
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

Stamp stamp_of(const std::string& text) { return parse_tum(text + " 0 0 0 0 0 0 1", "t")[0].stamp; }

TEST(Tum, StampsAreExact) {
  EXPECT_EQ(stamp_of("1583840261.039995392"), (Stamp{1583840261, 39995392}));
  EXPECT_EQ(stamp_of("12"), (Stamp{12, 0}));
  EXPECT_EQ(stamp_of("12.5"), (Stamp{12, 500000000}));
  EXPECT_EQ(stamp_of(".25"), (Stamp{0, 250000000}));
  EXPECT_EQ(stamp_of("1.305031102175300121e+09"), (Stamp{1305031102, 175300121}));
  EXPECT_EQ(stamp_of("1.5e-03"), (Stamp{0, 1500000}));
  EXPECT_EQ(stamp_of("12.0000000019999"), (Stamp{12, 1}));
}

TEST(Tum, RoundTrip) {
  const std::vector<StampedPose> poses = {
      {{1583840261, 39995392}, {Quat(0.8, 0, 0, 0.6), Vec3(0.1, -1.0 / 3.0, 5e-324)}},
      {{1583840262, 999999999}, SE3::exp((Vec6() << 1, 2, 3, 0.1, 0.2, 0.3).finished())}};
  const std::string text = format_tum(poses);
  const auto again = parse_tum(text, "t");
  ASSERT_EQ(again.size(), 2u);
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(again[i].stamp, poses[i].stamp);
    EXPECT_EQ(again[i].T_map_node.t, poses[i].T_map_node.t);
    EXPECT_EQ(again[i].T_map_node.q.coeffs(), poses[i].T_map_node.q.coeffs());
  }
  EXPECT_EQ(format_tum(again), text);
}

TEST(Tum, BadInput) {
  const std::string pose = " 0 0 0 0 0 0 1\n";
  EXPECT_EQ(refusal("# ok\n1" + pose + "2 0 0\n"),
            "t.tum:3: expected 8 fields (stamp x y z qx qy qz qw), found 3");
  EXPECT_NE(refusal("1746076987991696384" + pose).find("nanoseconds?"), std::string::npos);
  EXPECT_NE(refusal("abc" + pose).find("'abc'"), std::string::npos);
  EXPECT_NE(refusal("-1" + pose).find("'-1'"), std::string::npos);
  EXPECT_NE(refusal("1 0 0 0 0 0 0 0\n").find("quaternion is zero"), std::string::npos);
  EXPECT_NE(refusal("1 0 nan 0 0 0 0 1\n").find("finite"), std::string::npos);
  EXPECT_NE(refusal(std::string("\0\1\2", 3)).find("binary"), std::string::npos);
  EXPECT_EQ(refusal(""), "accepted");
}

}  // namespace
}  // namespace cambium
