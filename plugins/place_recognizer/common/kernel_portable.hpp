// SPDX-License-Identifier: BSD-3-Clause
// Plain C++, for any processor.
#pragma once
#include "common/kernel.hpp"

namespace columns {
extern const Kernel portable_kernel;
}  // namespace columns
