// SPDX-License-Identifier: BSD-3-Clause
// What is wrong with a pose graph is said with file and line, what was found and expected.
#include "cambium/dialect.hpp"
#include "cambium/error.hpp"
#include "support/support.hpp"

namespace cambium {
namespace {

struct BadGraph {
  const char* name;
  std::string text;
  std::string where;    ///< of the error
  std::string message;  ///< a part of it
};

const std::string v0 = "VERTEX_SE3:QUAT 0 0 0 0 0 0 0 1\n";
const std::string v1 = "VERTEX_SE3:QUAT 1 1 0 0 0 0 0 1\n";

class G2oBadInput : public ::testing::TestWithParam<BadGraph> {};

TEST_P(G2oBadInput, IsRefusedWithFileAndLine) {
  try {
    parse_g2o(GetParam().text, "bad.g2o");
    FAIL() << "expected an error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::data);
    EXPECT_EQ(error.where(), GetParam().where);
    EXPECT_NE(error.message().find(GetParam().message), std::string::npos) << error.what();
    for (const char c : error.message()) EXPECT_TRUE(c >= 32 && c < 127) << error.what();
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, G2oBadInput,
    ::testing::Values(
        BadGraph{"nan", "VERTEX_SE3:QUAT 0 nan 0 0 0 0 0 1\n", "bad.g2o:1", "finite"},
        BadGraph{"inf", v0 + "VERTEX_SE3:QUAT 1 0 0 -inf 0 0 0 1\n", "bad.g2o:2", "finite"},
        BadGraph{"nan_in_edge", v0 + v1 + "EDGE_SE3:QUAT 0 1 0 NaN 0 0 0 0 1\n", "bad.g2o:3",
                 "NaN"},
        BadGraph{"overflow", "VERTEX_SE3:QUAT 0 1e999 0 0 0 0 0 1\n", "bad.g2o:1", "range"},
        BadGraph{"zero_quaternion", v0 + "VERTEX_SE3:QUAT 1 0 0 0 0 0 0 0\n", "bad.g2o:2",
                 "quaternion is zero"},
        BadGraph{"tiny_quaternion", "VERTEX_SE3:QUAT 1 0 0 0 0 0 0 1e-200\n", "bad.g2o:1", "norm"},
        BadGraph{"decimal_comma", "VERTEX_SE3:QUAT 0 0,5 0 0 0 0 0 1\n", "bad.g2o:1",
                 "decimal commas"},
        BadGraph{"word", "VERTEX_SE3:QUAT 0 abc 0 0 0 0 0 1\n", "bad.g2o:1", "'abc'"},
        BadGraph{"too_few", v0 + "VERTEX_SE3:QUAT 1 0 0 0\n", "bad.g2o:2",
                 "expected 9 fields in a line 'VERTEX_SE3:QUAT', found 5"},
        BadGraph{"too_many", "VERTEX_SE3:QUAT 0 0 0 0 0 0 0 1 2\n", "bad.g2o:1",
                 "expected 9 fields in a line 'VERTEX_SE3:QUAT', found 10"},
        BadGraph{"edge_count", v0 + v1 + "EDGE_SE3:QUAT 0 1 0 0 0 0 0 0 1 5 5\n", "bad.g2o:3",
                 "expected 10 or 31 fields in a line 'EDGE_SE3:QUAT', found 12"},
        BadGraph{"truncated", v0 + "VERTEX_SE3:QUAT 1 0 0", "bad.g2o:2", "truncated"},
        BadGraph{"nanoseconds", "VERTEX_SE3:QUAT_TIME 0 0 0 0 0 0 0 1 5 1000000000\n", "bad.g2o:1",
                 "nanoseconds"},
        BadGraph{"fractional_seconds", "VERTEX_SE3:QUAT_TIME 0 0 0 0 0 0 0 1 5.5 0\n", "bad.g2o:1",
                 "seconds"},
        BadGraph{"negative_id", "VERTEX_SE3:QUAT -1 0 0 0 0 0 0 1\n", "bad.g2o:1", "vertex id"},
        BadGraph{"huge_id", "VERTEX_SE3:QUAT 9223372036854775808 0 0 0 0 0 0 1\n", "bad.g2o:1",
                 "vertex id"},
        BadGraph{"duplicate_vertex", v0 + v1 + "VERTEX_SE3:QUAT 0 5 0 0 0 0 0 1\n", "bad.g2o:3",
                 "line 1"},
        BadGraph{"missing_vertex", v0 + "EDGE_SE3:QUAT 0 9 0 0 0 0 0 0 1\n", "bad.g2o:2",
                 "vertex 9"},
        BadGraph{"missing_fixed", v0 + "FIX 0 9\n", "bad.g2o:2", "vertex 9"},
        BadGraph{"fix_nothing", v0 + "FIX\n", "bad.g2o:2", "found 1 fields"},
        BadGraph{"latitude", v0 + "GNSS_LLA_REF 125 61 0\n", "bad.g2o:2", "latitude"},
        BadGraph{"two_platforms", v0 + "PLATFORM_ID 1\nPLATFORM_ID 2\n", "bad.g2o:3", "line 2"},
        BadGraph{"empty", "", "bad.g2o", "no vertex"},
        BadGraph{"planar", "VERTEX_SE2 0 0 0 0\n", "bad.g2o", "line 1 is of a planar graph"},
        BadGraph{"binary", std::string("\x1f\x8b\x08\x00\x03garbage", 12), "bad.g2o",
                 "is binary, expected text: byte 0 is 0x1f"},
        BadGraph{"binary_tail", v0 + "\x01\x02\x03\xff garbage\n", "bad.g2o", "is binary"},
        BadGraph{"binary_far", v0 + std::string(5000, ' ') + "\n\x01\x02\xff\n", "bad.g2o:3",
                 "damaged from this line on"}),
    [](const auto& info) { return info.param.name; });

TEST(G2oBadInput, EveryTruncationParsesOrIsRefused) {
  const std::string text = v0 + v1 +
                           "EDGE_SE3:QUAT 0 1 0.125 0 0 0 0 0 1 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 "
                           "1 0 0 1 0 1\n";
  int refused = 0;
  for (std::size_t n = 0; n < text.size(); ++n) try {
      parse_g2o(std::string_view(text).substr(0, n), "cut.g2o");
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::data);
      ++refused;
    }
  EXPECT_GT(refused, 80);
}

TEST(G2oBadInput, MissingFileAndFolder) {
  const testing::TemporaryFolder folder;
  EXPECT_THROW(read_g2o(folder / "absent.g2o"), Error);
  EXPECT_THROW(read_g2o(folder.path()), Error);
}

TEST(G2oBadInput, CopiesOfAVertexAreLeftOutWithAWarning) {
  const Mission m = parse_g2o(v0 + v0 + v1, "twice.g2o");
  EXPECT_EQ(m.nodes.size(), 2u);
  EXPECT_EQ(m.warnings.size(), 1u);
}

}  // namespace
}  // namespace cambium
