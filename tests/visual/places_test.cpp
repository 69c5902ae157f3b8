// SPDX-License-Identifier: BSD-3-Clause
// visual_bow on pictures of the simulator's camera.
#include <algorithm>

#include "cambium/files.hpp"
#include "simulate/simulate.hpp"
#include "simulate/spec_file.hpp"
#include "support/support.hpp"
#include "support/thrown.hpp"

namespace cambium::testing {
namespace {

/// Two robots walk one loop through a simulated stand, the second 0.5 m beside the first.
struct Walks {
  TemporaryFolder folder;
  Atlas atlas;
  explicit Walks(const std::string& second = "path: {offset: 0.5}") {
    const std::string spec =
        "version: 1\nseed: 5\nstand: {size: [60, 60], density: 500}\n"
        "sensor: {clouds: false}\ncamera: {enabled: true, columns: 200, rows: 150}\n"
        "path: {size: [24, 16], spacing: 4}\n"
        "missions:\n  - {name: a}\n  - {name: b, " +
        second + "}\n";
    simulate::simulate(simulate::parse_spec(spec, "spec.yaml"), spec, folder.path(),
                       *make_context(2));
    atlas = make_atlas({read("a"), read("b")});
  }
  Mission read(const std::string& name) const {
    return component<MissionReader>("mission_folder")->read(folder / name, *make_context());
  }
};

const Walks& walks() {
  static const Walks once;
  return once;
}

std::vector<Candidate> match(const Atlas& atlas, const std::string& yaml, std::uint32_t query = 1,
                             int threads = 1) {
  const auto recognizer = component<PlaceRecognizer>("visual_bow", yaml);
  const auto context = make_context(threads);
  return recognizer->match(recognizer->describe({atlas, query}, *context),
                           recognizer->describe({atlas, 0}, *context), {}, *context);
}

double share_within(const Atlas& atlas, const std::vector<Candidate>& found, std::size_t steps) {
  const std::size_t count = atlas.missions[0].mission->nodes.size();
  const auto near = std::ranges::count_if(found, [&](const Candidate& c) {
    const std::size_t apart = c.query > c.reference ? c.query - c.reference : c.reference - c.query;
    return std::min(apart, count - apart) <= steps;
  });
  return double(near) / double(atlas.missions[1].mission->nodes.size());
}

TEST(VisualBow, ACopiedPlaceIsFoundFirstWithEverythingInCommon) {
  const auto found = match(walks().atlas, "{candidates: 1}", 0);
  ASSERT_EQ(found.size(), walks().atlas.missions[0].mission->nodes.size());
  for (const Candidate& c : found) {
    EXPECT_EQ(c.query, c.reference);
    EXPECT_NEAR(c.score, 1, 1e-9);
    EXPECT_FALSE(c.T_reference_query);
  }
}

TEST(VisualBow, ARevisitedPlaceIsFound) {
  const auto found = match(walks().atlas, "{candidates: 1}");
  EXPECT_GE(share_within(walks().atlas, found, 1), 0.7);
}

TEST(VisualBow, ManyThreadsGiveTheSameCandidates) {
  const auto one = match(walks().atlas, "{}", 1, 1), four = match(walks().atlas, "{}", 1, 4);
  ASSERT_EQ(one.size(), four.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].score, four[i].score);
    EXPECT_EQ(one[i].reference, four[i].reference);
  }
}

TEST(VisualBow, ADamagedPictureIsNamedAndOneThatIsMissingIsNoError) {
  const Walks own;
  const auto pictures = own.folder / "a" / "individual_images";
  std::vector<std::filesystem::path> files(std::filesystem::directory_iterator(pictures), {});
  std::ranges::sort(files);
  std::filesystem::remove(files[0]);
  const Atlas without = make_atlas({own.read("a"), own.read("b")});
  EXPECT_FALSE(match(without, "{}").empty());
  const auto digest = [&] { return own.read("a").nodes[1].payload->digest(); };
  const Digest before = digest();
  write_file(files[1], "no picture");
  EXPECT_NE(digest(), before);  // what the cache goes by
  const std::string said = thrown_by([&] { match(without, "{}"); });
  EXPECT_NE(said.find(files[1].string()), std::string::npos) << said;
  EXPECT_NE(said.find("cannot be read as a picture"), std::string::npos) << said;
}

TEST(VisualBow, MissionsWithoutPicturesGiveNothing) {
  const Atlas atlas = make_atlas({make_mission("a", {SE3{}}), make_mission("b", {SE3{}, SE3{}})});
  EXPECT_TRUE(match(atlas, "{min_score: 0}").empty());
}

}  // namespace
}  // namespace cambium::testing
