// SPDX-License-Identifier: BSD-3-Clause
// For x86-64 processors with AVX2 and FMA (2013), and with AVX-512 VNNI (2019).
#pragma once
#if defined(__x86_64__) && defined(__GNUC__)
#include "common/kernel.hpp"

namespace columns {
extern const Kernel avx2_kernel, avx512_kernel;
bool can_run_avx2();
bool can_run_avx512();
}  // namespace columns
#define COLUMNS_X86 1
#endif
