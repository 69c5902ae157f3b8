// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <random>

#include "bags.hpp"
#include "cambium/files.hpp"
#include "support/support.hpp"
#include "support/thrown.hpp"

namespace cambium::testing {
namespace {

using columns::Bits;
using visual_bow::Index;
using visual_bow::Vocabulary;

/// `count` descriptors around each of `centres` random ones, `flipped` bits away.
std::vector<Bits> clusters(std::size_t centres, std::size_t count, int flipped) {
  std::mt19937_64 random(3);
  std::vector<Bits> out;
  for (std::size_t c = 0; c < centres; ++c) {
    const Bits centre{random(), random(), random(), random()};
    for (std::size_t i = 0; i < count; ++i) {
      out.push_back(centre);
      for (int f = 0; f < flipped; ++f)
        out.back()[random() % 4] ^= std::uint64_t(1) << random() % 64;
    }
  }
  return out;
}

TEST(Vocabulary, WhatBelongsTogetherIsOneWord) {
  const auto all = clusters(12, 20, 6);
  const auto words = Vocabulary::grow(all, {12, 1}, 7, *make_context());
  EXPECT_EQ(words.words(), 12u);
  for (std::size_t i = 0; i < all.size(); ++i)
    EXPECT_EQ(words.word(all[i]), words.word(all[i - i % 20])) << i;
}

TEST(Vocabulary, TheSameSeedGivesTheSameTreeAndCopiesGiveOneWord) {
  const auto all = clusters(40, 10, 20);
  const auto a = Vocabulary::grow(all, {4, 3}, 7, *make_context());
  const auto b = Vocabulary::grow(all, {4, 3}, 7, *make_context(4));
  EXPECT_EQ(a.medians(), b.medians());
  EXPECT_GT(a.words(), 30u);
  EXPECT_LE(a.words(), 64u);
  EXPECT_EQ(Vocabulary::grow(std::vector<Bits>(50, all[0]), {4, 3}, 7, *make_context()).words(),
            1u);
}

TEST(Bags, SharesAndWeightsAreThoseOfTheDefinition) {
  // Two words, as a tree whose root has two children.
  const Vocabulary words({{1, 2, 0}, {0, 0, 2}, {0, 0, 0.5}}, {Bits{}, Bits{}, Bits{~0ull}});
  const Index grown(words, false, {{1, 1, 2}, {2}, {2}});
  const auto bag = grown.bag({1, 1, 2});
  const double one = 2 * std::log(4.0), two = std::log(4.0 / 3);
  ASSERT_EQ(bag.size(), 2u);
  EXPECT_NEAR(bag[0].second, one / (one + two), 1e-12);
  const auto similar = grown.similar(bag);
  EXPECT_NEAR(similar[0], 1, 1e-12);
  EXPECT_NEAR(similar[1], two / (one + two), 1e-12);
  EXPECT_NEAR(Index(words, true, {{2}}).bag({1, 2})[0].second, 2 / 2.5, 1e-12);
  EXPECT_EQ(grown.similar({}), (std::vector<double>{0, 0, 0}));
}

/// A grown tree in the text format of DBoW2, with all words alike.
std::string dbow2(const Vocabulary& words) {
  std::vector<std::size_t> parent(words.size());
  for (std::size_t i = 0; i < words.size(); ++i)
    for (std::size_t c = 0; c < words.nodes()[i].children; ++c)
      parent[words.nodes()[i].first_child + c] = i;
  std::string out = "10 4 0 0\n";
  for (std::size_t i = 1; i < words.size(); ++i) {
    out += std::to_string(parent[i]) + (words.nodes()[i].children == 0 ? " 1 " : " 0 ");
    for (std::size_t byte = 0; byte < 32; ++byte)
      out += std::to_string(words.medians()[i][byte / 8] >> 8 * (byte % 8) & 255) + " ";
    out += "1\n";
  }
  return out;
}

TEST(VisualBow, AVocabularyFileReadsBack) {
  const TemporaryFolder folder;
  const auto words = Vocabulary::grow(clusters(60, 10, 20), {6, 3}, 7, *make_context());
  write_file(folder / "words.txt", dbow2(words));
  const auto read = Vocabulary::read(folder / "words.txt");
  EXPECT_EQ(read.medians(), words.medians());
  for (const Bits& bits : clusters(60, 10, 20)) EXPECT_EQ(read.word(bits), words.word(bits));
}

TEST(VisualBow, WrongVocabulariesAreRefusedByLine) {
  const TemporaryFolder folder;
  const auto said = [&](const std::string& text) {
    write_file(folder / "words.txt", text);
    return thrown_by([&] { Vocabulary::read(folder / "words.txt"); });
  };
  EXPECT_NE(said("words").find("words.txt:1: found 'words' instead"), std::string::npos);
  EXPECT_NE(said("10 4 0 0\n7 1 0\n").find("words.txt:2: the parent is no node"),
            std::string::npos);
  EXPECT_NE(said("10 4 0 0\n0 1 1 2 3\n").find("words.txt:2: byte 4 of 32"), std::string::npos);
  EXPECT_NE(said("10 4 0 0\n").find("found no word"), std::string::npos);
}

}  // namespace
}  // namespace cambium::testing
