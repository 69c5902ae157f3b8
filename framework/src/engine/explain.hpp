// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "engine/report.hpp"

namespace cambium {

/// Says why a step ran again, by comparing its key with that of the run before in the same folder.
class Explainer {
 public:
  /// `previous`: the report.json of the run before; it may be absent.
  explicit Explainer(const std::filesystem::path& previous);

  std::string explain(std::size_t index, const StepRecord& step) const;

 private:
  Json previous_;
};

}  // namespace cambium
