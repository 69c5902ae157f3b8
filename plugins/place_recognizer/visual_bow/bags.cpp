// SPDX-License-Identifier: BSD-3-Clause
#include "bags.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace visual_bow {

Index::Index(const Vocabulary& vocabulary, bool weights_of_file,
             const std::vector<std::vector<std::size_t>>& pictures)
    : weights_(vocabulary.size(), 0.0), pictures_(vocabulary.size()), count_(pictures.size()) {
  std::vector<std::size_t> having(vocabulary.size(), 0);
  std::size_t not_empty = 0;
  for (const auto& words : pictures) {
    not_empty += !words.empty();
    for (const std::size_t word : std::set(words.begin(), words.end())) ++having[word];
  }
  for (std::size_t word = 0; word < weights_.size(); ++word)
    if (weights_of_file)
      weights_[word] = vocabulary.weight(word);
    else if (having[word] > 0)
      weights_[word] = std::log(double(1 + not_empty) / double(having[word]));
  for (std::size_t i = 0; i < pictures.size(); ++i)
    for (const auto& [word, share] : bag(pictures[i])) pictures_[word].emplace_back(i, share);
}

Bag Index::bag(const std::vector<std::size_t>& words) const {
  std::map<std::size_t, double> weighted;
  double sum = 0;
  for (const std::size_t word : words) {
    if (!(weights_[word] > 0)) continue;
    weighted[word] += weights_[word];
    sum += weights_[word];
  }
  Bag out(weighted.begin(), weighted.end());
  for (auto& [word, share] : out) share /= sum;
  return out;
}

std::vector<double> Index::similar(const Bag& bag) const {
  std::vector<double> out(count_, 0.0);
  for (const auto& [word, share] : bag)
    for (const auto& [picture, other] : pictures_[word]) out[picture] += std::min(share, other);
  return out;
}

}  // namespace visual_bow
