// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/diagnostics.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>

#include "cambium/error.hpp"

namespace cambium {
namespace {

// Optimal string alignment distance: a swap of neighbours ("rnigs") counts as one mistake.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  std::iota(last.begin(), last.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] != b[j - 1])});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
    std::swap(before, last);
    std::swap(last, row);
  }
  return last[b.size()];
}

}  // namespace

void Diagnostics::add(std::string where, std::string message) {
  entries_.push_back({std::move(where), std::move(message)});
}

void Diagnostics::throw_if_any() const {
  if (entries_.empty()) return;
  std::string text = entries_.front().message;
  for (std::size_t i = 1; i < entries_.size(); ++i)
    text += fmt::format("\n{}: {}", entries_[i].where, entries_[i].message);
  throw Error(ErrorCode::config, entries_.front().where, text);
}

std::string suggestion(std::string_view word, const std::vector<std::string>& known) {
  const std::string* best = nullptr;
  std::size_t best_distance = std::max<std::size_t>(1, word.size() / 3) + 1;
  for (const auto& candidate : known) {
    const std::size_t d = edit_distance(word, candidate);
    if (d < best_distance) {
      best = &candidate;
      best_distance = d;
    }
  }
  if (best) return fmt::format("; did you mean '{}'?", *best);
  if (known.empty()) return "; there are none";
  return fmt::format("; expected one of {}", fmt::join(known, ", "));
}

}  // namespace cambium
