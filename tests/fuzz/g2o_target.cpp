// SPDX-License-Identifier: BSD-3-Clause
// Any text is refused with an Error(data), or it parses and round-trips.
#include <sstream>

#include "cambium/dialect.hpp"
#include "cambium/error.hpp"
#include "fuzz.hpp"

using namespace cambium;

namespace {

std::string written(const Mission& mission) {
  std::ostringstream out;
  write_g2o(out, mission);
  return out.str();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Mission first;
  try {
    first = parse_g2o(fuzz::text(data, size), "fuzz.g2o");
  } catch (const Error& error) {
    fuzz::require(error.code() == ErrorCode::data, "a refusal is an error of the data");
    fuzz::require(error.where().starts_with("fuzz.g2o"), "a refusal names the file");
    return 0;
  }
  const std::string text = written(first);
  const Mission second = parse_g2o(text, "fuzz.g2o");  // what was written must not be refused
  fuzz::require(written(second) == text, "writing is idempotent");
  fuzz::require(second.digest == first.digest, "nothing is lost on the way");
  return 0;
}
