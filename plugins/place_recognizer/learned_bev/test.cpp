// SPDX-License-Identifier: BSD-3-Clause
#include "cambium/files.hpp"
#include "support/places.hpp"
#include "support/support.hpp"
#include "support/thrown.hpp"

namespace cambium::testing {
namespace {

Atlas atlas_of(const std::vector<std::vector<Cloud>>& missions) {
  std::vector<Mission> out;
  for (std::size_t m = 0; m < missions.size(); ++m) {
    out.push_back(
        make_mission(std::string(1, char('a' + m)), std::vector<SE3>(missions[m].size())));
    for (std::size_t i = 0; i < missions[m].size(); ++i)
      out.back().nodes[i].payload = in_memory(missions[m][i]);
  }
  return make_atlas(std::move(out));
}

std::vector<Candidate> match(const Atlas& atlas, const std::string& yaml, int threads = 1) {
  const auto recognizer = component<PlaceRecognizer>("learned_bev", yaml);
  const auto context = make_context(threads);
  return recognizer->match(recognizer->describe({atlas, 1}, *context),
                           recognizer->describe({atlas, 0}, *context), {}, *context);
}

std::vector<Cloud> walk(double yaw, std::size_t count = 10) {
  std::vector<Cloud> out;
  for (std::size_t i = 0; i < count; ++i)
    out.push_back(forest_scan(SE3::from_yaw(yaw * double(i), {14.0 * double(i), 0, 1.5})));
  return out;
}

std::string message(const std::string& yaml) {
  return thrown_by([&] { match(atlas_of({walk(0, 1), walk(0, 1)}), yaml); });
}

TEST(LearnedBev, FindsPlacesFromTheSameSpotUnderOtherHeadings) {
  const auto found = match(atlas_of({walk(0), walk(1.3)}), "{candidates: 1}");
  ASSERT_EQ(found.size(), 10U);
  std::size_t right = 0;
  for (const Candidate& c : found) right += c.query == c.reference;
  EXPECT_GE(right, 9U);
}

TEST(LearnedBev, ATurnByWholeSectorsChangesNothing) {
  const Cloud cloud = forest_scan(SE3::from_yaw(0, {0, 0, 1.5}));
  const Cloud turned = transformed(SE3::from_yaw(2 * 3.14159265358979 / 64 * 5 + 1e-7), cloud);
  const auto found = match(atlas_of({{cloud}, {turned}}), "{}");
  ASSERT_EQ(found.size(), 1U);
  EXPECT_GT(found[0].score, 0.9999);
}

TEST(LearnedBev, ANodeWithoutPointsMatchesNothing) {
  EXPECT_TRUE(match(atlas_of({{Cloud{}}, walk(0, 2)}), "{min_score: -1}").empty());
}

TEST(LearnedBev, TheNetworkInsideIsTheFileOfTheTree) {
  const auto file = source("plugins/place_recognizer/learned_bev/model/small.onnx").string();
  const Atlas atlas = atlas_of({walk(0, 4), walk(0.4, 4)});
  const auto own = match(atlas, "{}"), named = match(atlas, "{model: " + file + "}", 4);
  ASSERT_EQ(own.size(), named.size());
  for (std::size_t i = 0; i < own.size(); ++i) EXPECT_EQ(own[i].score, named[i].score);
}

TEST(LearnedBev, OtherSizesAndWrongFilesAreRefusedByName) {
  EXPECT_NE(message("{rows: 20}").find("does not run on an image of 1 x 1 x 20 x 64"),
            std::string::npos)
      << message("{rows: 20}");
  const TemporaryFolder folder;
  write_file(folder / "net.onnx", "no network");
  const std::string wrong = message("{model: " + (folder / "net.onnx").string() + "}");
  EXPECT_NE(wrong.find("net.onnx"), std::string::npos) << wrong;
  EXPECT_NE(wrong.find("cannot read this ONNX network"), std::string::npos) << wrong;
}

}  // namespace
}  // namespace cambium::testing
