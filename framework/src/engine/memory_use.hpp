// SPDX-License-Identifier: BSD-3-Clause
// What the process takes, as the system counts it.
#pragma once
#include <cstddef>
#include <string>

namespace cambium {

std::size_t resident_bytes();                ///< now; 0 where the system does not say
std::size_t peak_bytes();                    ///< the most so far
std::string shown_bytes(std::size_t bytes);  ///< "512M", "3.2G"

}  // namespace cambium
