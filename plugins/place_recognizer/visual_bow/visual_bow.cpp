// SPDX-License-Identifier: BSD-3-Clause
// Place recognition by the words of camera pictures.
#include <algorithm>
#include <cstring>
#include <mutex>

#include "bags.hpp"
#include "cambium/plugin.hpp"
#include "features.hpp"

namespace visual_bow {

using namespace cambium;
using columns::Bits;

// A row of the fingerprints: how many features the node has. `extra`: the number of nodes of the
// mission's own vocabulary (0: a file is used), these, their medians, all features node after node.

class VisualBow final : public PlaceRecognizer {
 public:
  void params(ParamVisitor& v) override {
    v("vocabulary", file_, "DBoW2 text file; none: the words of the reference's own pictures",
      in_unit("file"));
    v("branching", vocabulary_.branching, "Of a grown vocabulary: children of a node",
      between(2, 100));
    v("depth", vocabulary_.depth, "Of a grown vocabulary: at most branching^depth words",
      between(1, 8));
    v("features", features_.count, "At most so many corners of a picture", between(10, 5000));
    v("corner_threshold", features_.threshold,
      "By how much a corner differs from the pixels around it, of 255 (FAST)", between(1, 254));
    v("max_side", features_.max_side, "Larger pictures are scaled down to it",
      between(32, 8192, "pixels"));
    v("min_score", min_score_, "Pairs whose bags share less are not looked at", between(0.0, 1.0));
    v("checked", checked_,
      "So many of the most similar are compared corner by corner, which then gives the score; 0: "
      "none",
      between(0, 10000));
    v("max_bits", max_bits_, "Corners that differ in more of their 256 bits are not the same",
      between(0, 256));
    v("candidates", candidates_, "At most so many proposals for a query", between(1, 10000));
  }

  Fingerprints describe(const MissionView& mission, const Context& context) const override {
    std::vector<std::vector<Bits>> features(mission.size());
    context.parallel_for(features.size(), [&](std::size_t i) {
      context.check_cancelled();
      const auto images = mission.payload(i).images;
      if (!images) return;
      for (const Image& image : *images) {
        const auto found = features_of(image.file, features_);
        features[i].insert(features[i].end(), found.begin(), found.end());
      }
    });
    Fingerprints out{mission.size(), 1, {}, {}};
    std::vector<Bits> all;
    for (const auto& of_node : features) {
      out.table.push_back(float(of_node.size()));
      all.insert(all.end(), of_node.begin(), of_node.end());
    }
    const Vocabulary own =
        file_.empty() ? Vocabulary::grow(all, vocabulary_, context.seed(), context) : Vocabulary{};
    append(out.extra, std::vector<std::uint64_t>{own.size()});
    append(out.extra, own.nodes());
    append(out.extra, own.medians());
    append(out.extra, all);
    return out;
  }

  std::vector<Candidate> match(const Fingerprints& query, const Fingerprints& reference,
                               const Pairing& pairing, const Context& context) const override {
    const Decoded of_query = decode(query), of_reference = decode(reference);
    const Vocabulary& words = file_.empty() ? of_reference.own : vocabulary_of_file();
    if (words.size() == 0) {
      if (std::ranges::all_of(of_reference.features, &std::vector<Bits>::empty)) return {};
      throw Error(ErrorCode::config, "visual_bow",
                  "a mission was described for a vocabulary file, another one without; give all "
                  "platforms the same vocabulary");
    }
    const Index index(words, !file_.empty(), words_of(of_reference.features, words, context));
    const auto queries = words_of(of_query.features, words, context);
    std::vector<std::vector<Candidate>> found(query.rows);
    context.parallel_for(query.rows, [&](std::size_t q) {
      context.check_cancelled();
      const auto scores = index.similar(index.bag(queries[q]));
      for (std::size_t r = 0; r < scores.size(); ++r)
        if (scores[r] > 0 && scores[r] >= min_score_ && pairing.allowed(q, r))
          found[q].push_back({q, r, scores[r], {}});
      std::ranges::stable_sort(found[q], std::greater{}, &Candidate::score);
      if (checked_ > 0) check(of_query.features[q], of_reference.features, found[q]);
      found[q].resize(std::min(found[q].size(), std::size_t(candidates_)));
    });
    std::vector<Candidate> out;
    for (const auto& of_node : found) out.insert(out.end(), of_node.begin(), of_node.end());
    return out;
  }

 private:
  struct Decoded {
    Vocabulary own;
    std::vector<std::vector<Bits>> features;
  };

  /// The score becomes the share of corners that are each other's nearest, and near. A bag mixes up
  /// what looks alike; this does not.
  void check(const std::vector<Bits>& query, const std::vector<std::vector<Bits>>& references,
             std::vector<Candidate>& found) const {
    found.resize(std::min(found.size(), std::size_t(checked_)));
    for (Candidate& c : found) {
      const auto& reference = references[c.reference];
      const auto [of_query, of_reference] = columns::nearest_bits(query, reference);
      std::size_t same = 0;
      for (std::size_t i = 0; i < query.size(); ++i)
        same += of_query[i].distance <= max_bits_ && of_reference[of_query[i].index].index == i;
      c.score = double(same) / double(std::max(query.size(), reference.size()));
    }
    std::ranges::stable_sort(found, std::greater{}, &Candidate::score);
  }

  template <class T>
  static void append(std::vector<std::byte>& to, const std::vector<T>& values) {
    const auto bytes = std::as_bytes(std::span(values));
    to.insert(to.end(), bytes.begin(), bytes.end());
  }
  template <class T>
  static std::vector<T> take(const std::byte*& from, std::size_t count) {
    std::vector<T> out(count);
    if (count > 0) std::memcpy(out.data(), from, count * sizeof(T));
    from += count * sizeof(T);
    return out;
  }

  static Decoded decode(const Fingerprints& fingerprints) {
    Decoded out;
    if (fingerprints.rows == 0) return out;
    const std::byte* from = fingerprints.extra.data();
    const auto nodes = std::size_t(take<std::uint64_t>(from, 1)[0]);
    auto tree = take<Vocabulary::Node>(from, nodes);
    out.own = {std::move(tree), take<Bits>(from, nodes)};
    for (std::size_t i = 0; i < fingerprints.rows; ++i)
      out.features.push_back(take<Bits>(from, std::size_t(fingerprints.row(i)[0])));
    return out;
  }

  static std::vector<std::vector<std::size_t>> words_of(
      const std::vector<std::vector<Bits>>& features, const Vocabulary& words,
      const Context& context) {
    std::vector<std::vector<std::size_t>> out(features.size());
    context.parallel_for(out.size(), [&](std::size_t i) {
      context.check_cancelled();
      for (const Bits& bits : features[i]) out[i].push_back(words.word(bits));
    });
    return out;
  }

  // A vocabulary of a million words takes seconds to read: once is enough.
  const Vocabulary& vocabulary_of_file() const {
    std::call_once(read_, [this] { of_file_ = Vocabulary::read(file_); });
    return of_file_;
  }

  std::string file_;
  VocabularyOptions vocabulary_;
  FeatureOptions features_;
  double min_score_ = 0.02;
  int checked_ = 20, max_bits_ = 50, candidates_ = 5;
  mutable std::once_flag read_;
  mutable Vocabulary of_file_;
};

}  // namespace visual_bow

CAMBIUM_PLUGIN("visual_bow", "0.1.0") {
  registry.add<visual_bow::VisualBow>("visual_bow",
                                      "ORB words of camera pictures, weighted and indexed");
}
