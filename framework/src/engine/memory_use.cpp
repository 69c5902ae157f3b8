// SPDX-License-Identifier: BSD-3-Clause
#include "engine/memory_use.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdio>

namespace cambium {

std::size_t resident_bytes() {
  std::FILE* const file = std::fopen("/proc/self/statm", "r");
  if (!file) return 0;
  std::size_t size = 0, resident = 0;
  const int read = std::fscanf(file, "%zu %zu", &size, &resident);
  std::fclose(file);
  return read == 2 ? resident * std::size_t(::sysconf(_SC_PAGESIZE)) : 0;
}

std::size_t peak_bytes() {
  rusage usage{};
  return ::getrusage(RUSAGE_SELF, &usage) == 0 ? std::size_t(usage.ru_maxrss) * 1024 : 0;
}

std::string shown_bytes(std::size_t bytes) {
  const double mega = double(bytes) / (1 << 20);
  return mega < 1024 ? fmt::format("{:.0f}M", mega) : fmt::format("{:.1f}G", mega / 1024);
}

}  // namespace cambium
