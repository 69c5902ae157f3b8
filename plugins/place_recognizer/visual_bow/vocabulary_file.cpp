// SPDX-License-Identifier: BSD-3-Clause
#include <fstream>
#include <sstream>

#include "cambium/error.hpp"
#include "vocabulary.hpp"

namespace visual_bow {
namespace {

using cambium::Error;
using cambium::ErrorCode;
using columns::Bits;

/// The nodes as they stand in the file, the root first.
struct Lines {
  std::vector<std::vector<std::size_t>> children;
  std::vector<Bits> medians;
  std::vector<float> weights;
};

[[noreturn]] void refuse(const std::filesystem::path& file, std::size_t line,
                         const std::string& what) {
  throw Error(ErrorCode::data, file.string() + ":" + std::to_string(line),
              what + "; expected a vocabulary in the text format of DBoW2");
}

Lines read_lines(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) throw Error(ErrorCode::data, file.string(), "cannot be opened for reading");
  std::string text;
  std::getline(in, text);
  std::istringstream head(text);
  int branching = 0, depth = 0, scoring = 0, weighting = 0;
  if (!(head >> branching >> depth >> scoring >> weighting) || branching < 2 || depth < 1)
    refuse(file, 1, "found '" + text.substr(0, 40) + "' instead of four numbers");
  Lines out{{{}}, {{}}, {0}};
  for (std::size_t line = 2; std::getline(in, text); ++line) {
    if (text.find_first_not_of(" \r") == text.npos) continue;
    std::istringstream words(text);
    std::size_t parent = 0;
    int leaf = 0, byte = 0;
    words >> parent >> leaf;
    if (!words || parent >= out.children.size())
      refuse(file, line, "the parent is no node of a line before");
    Bits bits{};
    for (std::size_t i = 0; i < 32; ++i) {
      if (!(words >> byte) || byte < 0 || byte > 255)
        refuse(file, line, "byte " + std::to_string(i + 1) + " of 32 is no number from 0 to 255");
      bits[i / 8] |= std::uint64_t(byte) << 8 * (i % 8);
    }
    float weight = 0;
    if (!(words >> weight) || !(weight >= 0)) refuse(file, line, "the weight is no number from 0");
    out.children[parent].push_back(out.children.size());
    out.children.emplace_back();
    out.medians.push_back(bits);
    out.weights.push_back(weight);
  }
  if (out.children.size() < 2) refuse(file, 2, "found no word");
  return out;
}

}  // namespace

Vocabulary Vocabulary::read(const std::filesystem::path& file) {
  const Lines lines = read_lines(file);
  Vocabulary out;
  std::vector<std::size_t> order{0};  // of the file's nodes: level by level, children side by side
  for (std::size_t at = 0; at < order.size(); ++at) {
    const auto& children = lines.children[order[at]];
    out.nodes_.push_back({std::uint32_t(children.empty() ? 0 : order.size()),
                          std::uint32_t(children.size()), lines.weights[order[at]]});
    out.medians_.push_back(lines.medians[order[at]]);
    order.insert(order.end(), children.begin(), children.end());
  }
  return out;
}

}  // namespace visual_bow
