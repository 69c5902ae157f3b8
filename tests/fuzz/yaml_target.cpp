// SPDX-License-Identifier: BSD-3-Clause
// A pipeline text either throws cambium::Error or gives steps that all have a verb.
#include <cstdlib>

#include "pipeline/pipeline.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const std::string text(reinterpret_cast<const char*>(data), size);
    const cambium::Pipeline p = cambium::parse_pipeline(text, "fuzz.yaml");
    for (const auto& step : p.steps)
      if (!step.verb) std::abort();
  } catch (const cambium::Error&) {
  }
  return 0;
}
