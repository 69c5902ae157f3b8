// SPDX-License-Identifier: BSD-3-Clause
#include "engine/share.hpp"

#include "engine/resolve.hpp"

namespace cambium {

std::vector<std::size_t> waves_of(const ResolvedPipeline& pipeline) {
  std::vector<std::size_t> out;
  std::size_t wave = 0;
  bool open = false;
  for (const Step& step : pipeline.steps) {
    const Kind kind = step.verb->kind;
    const bool recognize = kind == Kind::place_recognizer;
    if (recognize && !open) ++wave;
    // Filters are lazy and metrics and exports change nothing, so they end no wave.
    if (recognize)
      open = true;
    else if (kind == Kind::loop_verifier || kind == Kind::solver || kind == Kind::gnss_aligner)
      open = false;
    out.push_back(open && (recognize || kind == Kind::registration) ? wave : 0);
  }
  return out;
}

}  // namespace cambium
