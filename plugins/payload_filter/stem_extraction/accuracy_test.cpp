// SPDX-License-Identifier: BSD-3-Clause
#include <cstring>

#include "cambium/files.hpp"
#include "forest.hpp"

namespace stem_extraction::testing {
namespace {

using namespace cambium;
using namespace cambium::testing;

TEST(StemExtraction, AnArcOfOneSideDoesNotBiasTheDiameter) {
  for (const double arc : {M_PI, 2.1})
    for (const double dbh : {0.12, 0.2, 0.4}) {
      double sum = 0;
      int count = 0;
      for (int i = 0; i < 8; ++i) {
        Scene scene;
        scene.arc = arc;
        scene.noise = 0.015;
        scene.add_ground();
        const double turn = 2 * M_PI * i / 8;
        scene.add_stem(7 * std::cos(turn), 7 * std::sin(turn), dbh);
        for (const Tree& t : trees(scene.cloud, "{join_radius: 0.1}")) sum += t.dbh - dbh, ++count;
      }
      EXPECT_EQ(count, 8) << dbh << " " << arc;
      EXPECT_LT(std::abs(sum / count), 0.012) << dbh << " " << arc;
    }
}

/// The points of a binary PCD file with fields x y z, from the middle of their box.
Cloud read_plot(const std::filesystem::path& file) {
  const std::string bytes = read_file(file), word = "DATA binary\n";
  const std::size_t begin = bytes.find(word) + word.size();
  Cloud cloud;
  cloud.xyz.resize((bytes.size() - begin) / 12 * 3);
  std::memcpy(cloud.xyz.data(), bytes.data() + begin, cloud.xyz.size() * 4);
  const Eigen::Vector3f low = cloud.points().rowwise().minCoeff();
  const Eigen::Vector3f high = cloud.points().rowwise().maxCoeff();
  cloud.points().colwise() -= Eigen::Vector3f(0.5f * (low + high));
  return cloud;
}

// A pine plot of 27 x 26 m scanned on foot: no truth, but pines stand apart and have plausible
// diameters.
TEST(StemExtraction, FindsThePinesOfARealPlot) {
  const auto data = real_data("aerial_terrestrial_ftvalley");
  if (data.empty()) GTEST_SKIP() << "aerial_terrestrial_ftvalley is not here";
  const auto found = trees(read_plot(data / "MLS_Clip.pcd"), "{max_range: 20}");
  std::vector<Tree> sure;
  for (const Tree& t : found)
    if (t.score >= 0.9) sure.push_back(t);
  EXPECT_GE(sure.size(), 18u);
  EXPECT_LE(sure.size(), 28u);
  for (std::size_t i = 0; i < sure.size(); ++i) {
    EXPECT_GT(sure[i].dbh, 0.2);
    EXPECT_LT(sure[i].dbh, 0.6);
    EXPECT_GT(sure[i].axis.z(), std::cos(0.2));
    for (std::size_t k = 0; k < i; ++k) EXPECT_GT((sure[i].base - sure[k].base).norm(), 0.5);
  }
}

}  // namespace
}  // namespace stem_extraction::testing
