// SPDX-License-Identifier: BSD-3-Clause
// Any text is refused with an Error(data), or it parses and round-trips.
#include "cambium/error.hpp"
#include "cambium/files.hpp"
#include "fuzz.hpp"

using namespace cambium;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::vector<StampedPose> poses;
  try {
    poses = parse_tum(fuzz::text(data, size), "fuzz.tum");
  } catch (const Error& error) {
    fuzz::require(error.code() == ErrorCode::data, "a refusal is an error of the data");
    fuzz::require(error.where().starts_with("fuzz.tum"), "a refusal names the file");
    return 0;
  }
  const std::string text = format_tum(poses);
  fuzz::require(format_tum(parse_tum(text, "fuzz.tum")) == text, "writing is idempotent");
  return 0;
}
