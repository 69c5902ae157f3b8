// SPDX-License-Identifier: BSD-3-Clause
// What a call complains about.
#pragma once
#include <string>

#include "cambium/error.hpp"

namespace cambium::testing {

/// The message of the Error that `call` throws.
template <class Call>
std::string thrown_by(const Call& call) {
  try {
    call();
  } catch (const Error& e) {
    return e.what();
  }
  return "nothing was thrown";
}

}  // namespace cambium::testing
