// SPDX-License-Identifier: BSD-3-Clause
// 128-bit content digests (XXH3). They name artefacts in the cache; they are no signature.
#pragma once
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace cambium {

struct Digest {
  std::uint64_t high = 0, low = 0;
  friend bool operator==(const Digest&, const Digest&) = default;
  friend auto operator<=>(const Digest&, const Digest&) = default;
  std::string hex() const;  ///< 32 hexadecimal characters
};

Digest digest_bytes(std::string_view bytes);
Digest digest_file(const std::filesystem::path& path);  ///< throws Error(data)

/// Feeds values one after another; every value is framed by its length, so ("ab","c") and
/// ("a","bc") differ.
class Hasher {
 public:
  Hasher& add(std::string_view bytes);
  Hasher& add(const Digest& digest);
  Hasher& add(double value);
  Hasher& add(std::uint64_t value);
  Digest digest() const { return digest_bytes(buffer_); }

 private:
  std::string buffer_;
};

}  // namespace cambium
