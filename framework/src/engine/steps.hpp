// SPDX-License-Identifier: BSD-3-Clause
// One function a verb. A step takes what is known so far and returns it with its own part added.
#pragma once
#include "engine/engine.hpp"
#include "engine/resolve.hpp"
#include "engine/share.hpp"

namespace cambium {

struct Known {
  Atlas atlas;
  std::map<std::string, std::shared_ptr<const PayloadSources>> streams;
  std::vector<Metric> metrics;
  const Step* relaxed_by = nullptr;  ///< the last `optimize` so far
};

using KeyParts = std::vector<std::pair<std::string, std::string>>;

/// What one step did, for the report.
struct StepRecord {
  std::string verb, plugin, label;
  double seconds = 0;
  std::size_t items = 0, cached = 0;  ///< work items, and how many of them came from the cache
  double work = 0;  ///< what making its results took [s], now or then; the sum of the threads
  std::string summary;                       ///< one line for the user
  KeyParts key;                              ///< named parts of its cache key
  std::vector<Score> figures;                ///< e.g. cost before and after
  std::vector<std::filesystem::path> files;  ///< written by an export
  std::vector<Metric> metrics;               ///< of an evaluator, without label
};

/// What a step may use.
struct StepScope {
  const Step& step;
  const Engine& engine;
  std::uint64_t seed;
  std::filesystem::path out;
  StepRecord& record;
  const Share* share = nullptr;  ///< when other processes compute the rest of the step

  /// Runs `count` work items side by side, counting and showing them. `item(i)` returns how the
  /// result came about.
  void run_items(std::size_t count, const std::function<Making(std::size_t)>& item) const;
  /// The cached result of one item. `input` is the digest of what it reads.
  template <class T>
  T cached(const Configured& c, const Digest& input, Making& making,
           const std::function<T(const Context&)>& compute) const {
    const Digest key = item_key(c, input);
    return engine.cached<T>(key, step.title(), making,
                            [&] { return compute(*engine.context(key, seed)); });
  }
  Digest item_key(const Configured& c, const Digest& input) const;
};

Known run_filter(Known known, const StepScope& scope);
Known run_recognize(Known known, const StepScope& scope);
Known run_register(Known known, const StepScope& scope);
Known run_verify(Known known, const StepScope& scope);
Known run_optimize(Known known, const StepScope& scope);
Known run_georeference(Known known, const StepScope& scope);
Known run_export(Known known, const StepScope& scope);
Known run_evaluate(Known known, const StepScope& scope);

/// The function of a verb.
using StepFunction = Known (*)(Known, const StepScope&);
StepFunction step_function(Kind kind);

}  // namespace cambium
