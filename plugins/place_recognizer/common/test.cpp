// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <random>

#include "common/distance.hpp"
#include "common/hamming.hpp"
#include "common/search.hpp"
#include "support/support.hpp"

namespace columns {
namespace {

using cambium::Fingerprints;
using Descriptor = std::vector<float>;

// Columns of unit length, a share of them empty. `spread` 0: all the same, 1: nothing in common.
std::vector<Descriptor> descriptors(Shape shape, std::size_t count, double filled, double spread,
                                    unsigned seed) {
  std::mt19937 random(seed), base(99);
  const auto next = [](std::mt19937& r) { return float(r() % 65536) / 65536.0f; };
  Descriptor common(shape.bins());
  for (float& x : common) x = next(base);
  std::vector<Descriptor> out(count, Descriptor(shape.bins(), 0.0f));
  for (Descriptor& d : out)
    for (int s = 0; s < shape.sectors; ++s) {
      if (next(random) > filled) continue;
      Eigen::Map<Eigen::VectorXf> column(d.data() + s * shape.rings, shape.rings);
      for (int i = 0; i < shape.rings; ++i)
        column[i] = common[std::size_t(s * shape.rings + i)] * float(1 - spread) +
                    (next(random) < 0.5f ? 0.0f : next(random)) * float(spread);
      column.stableNormalize();
    }
  return out;
}

// A walk: each differs a little from the one before and is turned, as along a path.
std::vector<Descriptor> walk(Shape shape, std::size_t count, unsigned seed) {
  auto out = descriptors(shape, count, 1.0, 1.0, seed);
  for (std::size_t i = 1; i < count; ++i)
    for (int s = 0; s < shape.sectors; ++s) {
      Eigen::Map<Eigen::VectorXf> column(out[i].data() + s * shape.rings, shape.rings);
      const int from = (s + 1) % shape.sectors;
      column = 0.05f * column + 0.95f * Eigen::Map<Eigen::VectorXf>(
                                            out[i - 1].data() + from * shape.rings, shape.rings);
      column.stableNormalize();
    }
  return out;
}

Fingerprints fingerprints(const std::vector<Descriptor>& all, Shape shape, std::size_t views = 1) {
  Fingerprints out{all.size() / views, shape.bins() * views, {}, {}};
  for (const Descriptor& d : all) out.table.insert(out.table.end(), d.begin(), d.end());
  out.extra.resize(tile_bytes(out.rows, shape));
  encode_tiles(out, {out, shape, views}, *cambium::testing::make_context());
  return out;
}

struct Found {
  std::size_t reference, view;
  double distance;
  int shift;
};

// The definition: everything against everything.
std::vector<Found> brute_force(const Table& queries, std::size_t q, const Table& references,
                               const Limits& limits) {
  const Shape shape = references.shape;
  const auto rings = std::size_t(shape.rings), sectors = std::size_t(shape.sectors);
  const auto is_empty = [&](std::span<const float> d, std::size_t s) {
    for (std::size_t i = 0; i < rings; ++i)
      if (d[s * rings + i] != 0) return false;
    return true;
  };
  const double least = std::max(1.0, std::ceil(limits.min_overlap * shape.sectors));
  std::vector<Found> all;
  for (std::size_t r = 0; r < references.size(); ++r) {
    Found best{r, 0, std::numeric_limits<double>::infinity(), 0};
    for (std::size_t v = 0; v < queries.views; ++v)
      for (std::size_t k = 0; k < sectors; ++k) {
        const auto a = queries.descriptor(q, v), b = references.descriptor(r, 0);
        double sum = 0;
        int n = 0;
        for (std::size_t s = 0; s < sectors; ++s) {
          const std::size_t t = (s + k) % sectors;
          double cosine = 0;
          for (std::size_t i = 0; i < rings; ++i)
            cosine += double(a[s * rings + i]) * double(b[t * rings + i]);
          sum += cosine;
          n += !is_empty(a, s) && !is_empty(b, t);
        }
        if (n < least) continue;
        const double d = std::max(0.0, 1.0 - sum / n);
        if (d < best.distance) best = {r, v, d, int(k)};
      }
    if (best.distance <= limits.threshold) all.push_back(best);
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Found& a, const Found& b) { return a.distance < b.distance; });
  all.resize(std::min(all.size(), std::size_t(limits.candidates)));
  return all;
}

void expect_the_same(const Fingerprints& query, const Fingerprints& reference, Shape shape,
                     std::size_t views, const Limits& limits, const std::string& what) {
  const Table queries{query, shape, views}, references{reference, shape};
  std::vector<std::vector<Found>> expected;
  for (std::size_t q = 0; q < queries.size(); ++q)
    expected.push_back(brute_force(queries, q, references, limits));
  for (const Kernel& kernel : kernels()) {
    SCOPED_TRACE(what + ", " + kernel.name);
    const auto matches =
        search(queries, references, {}, limits, *cambium::testing::make_context(), kernel);
    for (std::size_t q = 0; q < queries.size(); ++q) {
      ASSERT_EQ(matches[q].size(), expected[q].size());
      for (std::size_t i = 0; i < expected[q].size(); ++i) {
        const Match& match = matches[q][i];
        EXPECT_EQ(match.reference, expected[q][i].reference);
        EXPECT_EQ(match.view, expected[q][i].view);
        EXPECT_EQ(match.distance, expected[q][i].distance);
        const double apart = std::remainder(match.shift - expected[q][i].shift, shape.sectors);
        EXPECT_LE(std::abs(apart), 0.5);
      }
    }
  }
}

constexpr Shape shapes[] = {{20, 60}, {10, 60}, {7, 31}, {5, 128}, {3, 200}, {1, 4}, {40, 24}};

TEST(Columns, TheSameAsTheDefinitionForAnyShape) {
  for (const Shape shape : shapes)
    for (const double filled : {1.0, 0.8, 0.3}) {
      const auto query = fingerprints(descriptors(shape, 3, filled, 0.8, 1), shape);
      const auto reference = fingerprints(descriptors(shape, 101, filled, 0.8, 2), shape);
      const std::string what = std::to_string(shape.rings) + " x " + std::to_string(shape.sectors) +
                               ", filled " + std::to_string(filled);
      for (const Limits& limits : {Limits{10, 0.4, 0.25}, {3, 1.0, 0.0}, {1000, 1.0, 0.5}})
        expect_the_same(query, reference, shape, 1, limits, what);
    }
}

TEST(Columns, TheSameAsTheDefinitionWhereAllLookAlike) {
  const Shape shape{20, 60};
  for (const double spread : {0.0, 1e-6, 1e-4, 1e-2}) {
    const auto query = fingerprints(descriptors(shape, 2, 1.0, spread, 1), shape);
    const auto reference = fingerprints(descriptors(shape, 150, 1.0, spread, 2), shape);
    expect_the_same(query, reference, shape, 1, {10, 0.4, 0.25},
                    "spread " + std::to_string(spread));
  }
}

TEST(Columns, TheSameAsTheDefinitionAlongAPath) {
  const Shape shape{20, 60};
  auto path = walk(shape, 400, 3);
  const std::vector<Descriptor> some = {path[0], path[177], path[399]};
  expect_the_same(fingerprints(some, shape), fingerprints(path, shape), shape, 1, {10, 0.4, 0.25},
                  "path");
}

TEST(Columns, OfSeveralViewsTheBestCounts) {
  const Shape shape{10, 60};
  auto views = descriptors(shape, 12, 0.9, 0.7, 5);
  auto path = descriptors(shape, 90, 0.9, 0.7, 6);
  path.insert(path.end(), views.begin(), views.begin() + 6);
  expect_the_same(fingerprints(views, shape, 4), fingerprints(path, shape), shape, 4,
                  {5, 1.0, 0.25}, "views");
}

TEST(Columns, NothingMatchesAnEmptyDescriptor) {
  const Shape shape{20, 60};
  std::vector<Descriptor> some = descriptors(shape, 20, 1.0, 1.0, 1);
  some[4].assign(shape.bins(), 0.0f);
  const auto all = fingerprints(some, shape);
  const auto matches =
      search({all, shape}, {all, shape}, {}, {100, 1.0, 0.0}, *cambium::testing::make_context());
  EXPECT_TRUE(matches[4].empty());
  for (std::size_t q = 0; q < matches.size(); ++q)
    for (const Match& m : matches[q]) EXPECT_NE(m.reference, 4u);
}

/// Queries as kernels take them.
struct Screenings {
  Screenings(const std::vector<Descriptor>& queries, const Transform& transform)
      : spectra(queries.size()) {
    for (const Descriptor& query : queries) coarse.emplace_back(query, transform);
    for (std::size_t q = 0; q < queries.size(); ++q) {
      spectra[q].resize(transform.shape().frequencies() * 2 * lanes);
      all.push_back({&coarse[q], 1.0f, 1.0f, spectra[q].data()});
    }
  }
  std::vector<CoarseQuery> coarse;
  std::vector<std::vector<float>> spectra;
  std::vector<Screening> all;
};

/// Lanes, and the sums of all shifts.
std::pair<unsigned, std::vector<float>> weighed(const Kernel& kernel,
                                                const InverseTransform& inverse,
                                                const std::byte* tile, const Screening& screened) {
  std::vector<float> sums(std::size_t(inverse.shape.sectors) * lanes);
  const unsigned possible = kernel.weigh(inverse, tile, screened, sums.data());
  return {possible, std::move(sums)};
}

// What the search stands on: no kernel is farther off than it says.
TEST(Columns, KernelsKeepTheirBounds) {
  for (const Shape shape : shapes) {
    const Transform transform(shape);
    const InverseTransform inverse(shape);
    const TileLayout layout(shape);
    const auto queries = descriptors(shape, 5, 0.9, 0.9, 1);  // kernels take four at once, or one
    const auto references = descriptors(shape, lanes, 0.9, 0.9, 2);
    const auto table = fingerprints(references, shape);
    const std::byte* tile = Table{table, shape}.tile(0);
    for (const Kernel& kernel : kernels()) {
      Screenings asked(queries, transform);
      kernel.screen(shape, tile, asked.all, false);
      for (std::size_t q = 0; q < queries.size(); ++q) {
        asked.all[q].possible = ~0u;
        const auto sums = weighed(kernel, inverse, tile, asked.all[q]).second;
        const CoarseQuery& coarse = asked.coarse[q];
        for (std::size_t lane = 0; lane < lanes; ++lane) {
          const double bound = coarse.per_error * read<float>(tile + layout.error, lane) +
                               coarse.per_norm * read<float>(tile + layout.norm, lane);
          EXPECT_LT(bound, 0.05 * shape.sectors);
          for (std::size_t k = 0; k < std::size_t(shape.sectors); ++k)
            EXPECT_NEAR(sums[k * lanes + lane], correlation(queries[q], references[lane], shape, k),
                        bound)
                << kernel.name;
        }
      }
    }
  }
}

// A distance that is just tolerated must pass, whatever the shift that has it.
TEST(Columns, ScreeningLosesNothing) {
  for (const Shape shape : shapes) {
    const auto all = descriptors(shape, 64, 0.85, 0.6, 4);
    const auto table = fingerprints(all, shape);
    const Table of{table, shape};
    const InverseTransform inverse(shape);
    for (std::size_t q = 0; q < 8; ++q)
      for (const Found& found : brute_force(of, q, of, {64, 1.0, 0.25}))
        for (const Kernel& kernel : kernels()) {
          Screenings asked({all[q]}, Transform(shape));
          asked.all[0].tolerated = float(found.distance);
          asked.all[0].least_columns = float(std::max(1.0, std::ceil(0.25 * shape.sectors)));
          const std::byte* tile = of.tile(found.reference / lanes);
          kernel.screen(shape, tile, asked.all, true);
          const unsigned possible = weighed(kernel, inverse, tile, asked.all[0]).first;
          EXPECT_TRUE(possible >> found.reference % lanes & 1) << kernel.name;
        }
  }
}

TEST(Hamming, TheNearestOfBothSidesAndTheFirstOfEquals) {
  std::mt19937_64 random(5);
  std::vector<Bits> a(40), b(50);
  for (auto* all : {&a, &b})
    for (Bits& bits : *all)
      for (auto& word : bits) word = random() & random() & random();
  b[7] = b[30] = a[3];  // of two that are as near the first counts
  a[20] = {};
  const auto [of_a, of_b] = nearest_bits(a, b);
  const auto differ = [](const Bits& x, const Bits& y) {
    int out = 0;
    for (std::size_t w = 0; w < 4; ++w)
      for (int bit = 0; bit < 64; ++bit) out += int((x[w] >> bit & 1) != (y[w] >> bit & 1));
    return out;
  };
  const auto check = [&](const auto& from, const auto& to, const auto& found) {
    for (std::size_t i = 0; i < from.size(); ++i) {
      std::size_t best = 0;
      for (std::size_t k = 1; k < to.size(); ++k)
        if (differ(from[i], to[k]) < differ(from[i], to[best])) best = k;
      EXPECT_EQ(found[i].index, best);
      EXPECT_EQ(found[i].distance, differ(from[i], to[best]));
    }
  };
  check(a, b, of_a);
  check(b, a, of_b);
  EXPECT_EQ(of_a[3].index, 7u);
  EXPECT_EQ(nearest_bits(a, {}).first[0].distance, 257);
}

}  // namespace
}  // namespace columns
