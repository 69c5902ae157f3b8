// SPDX-License-Identifier: BSD-3-Clause
#include "common/kernel.hpp"

#include <vector>

#include "common/kernel_portable.hpp"
#include "common/kernel_x86.hpp"

namespace columns {

std::span<const Kernel> kernels() {
  static const std::vector<Kernel> all = [] {
    std::vector<Kernel> found;
#ifdef COLUMNS_X86
    if (can_run_avx512()) found.push_back(avx512_kernel);
    if (can_run_avx2()) found.push_back(avx2_kernel);
#endif
    found.push_back(portable_kernel);
    return found;
  }();
  return all;
}

}  // namespace columns
