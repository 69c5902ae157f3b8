// SPDX-License-Identifier: BSD-3-Clause
#include "cambium/digest.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <cstring>
#include <fstream>
#include <memory>
#include <vector>

#include "cambium/error.hpp"

namespace cambium {

std::string Digest::hex() const { return fmt::format("{:016x}{:016x}", high, low); }

Digest digest_bytes(std::string_view bytes) {
  const XXH128_hash_t h = XXH3_128bits(bytes.data(), bytes.size());
  return {h.high64, h.low64};
}

Digest digest_file(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw Error(ErrorCode::data, path.string(), "cannot be opened for reading");
  const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state(XXH3_createState(),
                                                                       &XXH3_freeState);
  XXH3_128bits_reset(state.get());
  std::vector<char> block(1 << 18);
  while (in.read(block.data(), std::streamsize(block.size())) || in.gcount() > 0)
    XXH3_128bits_update(state.get(), block.data(), std::size_t(in.gcount()));
  if (in.bad()) throw Error(ErrorCode::data, path.string(), "cannot be read to its end");
  const XXH128_hash_t h = XXH3_128bits_digest(state.get());
  return {h.high64, h.low64};
}

Hasher& Hasher::add(std::string_view bytes) {
  const std::uint64_t size = bytes.size();
  buffer_.append(reinterpret_cast<const char*>(&size), sizeof size);
  buffer_.append(bytes);
  return *this;
}

Hasher& Hasher::add(const Digest& digest) {
  return add(std::string_view(reinterpret_cast<const char*>(&digest), sizeof digest));
}

Hasher& Hasher::add(double value) {
  return add(std::string_view(reinterpret_cast<const char*>(&value), sizeof value));
}

Hasher& Hasher::add(std::uint64_t value) {
  return add(std::string_view(reinterpret_cast<const char*>(&value), sizeof value));
}

}  // namespace cambium
