// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cache.hpp"

#include <cstdlib>
#include <cstring>

#include "cambium/error.hpp"
#include "cambium/files.hpp"

namespace cambium {
namespace {

namespace fs = std::filesystem;

// An entry is magic, digest of the content, content. The digest finds what a full disk, a crash or
// a bad sector left behind, so an entry needs no fsync: a lost one is computed again.
constexpr char magic[8] = {'C', 'A', 'M', 'B', 'I', 'U', 'M', '1'};
constexpr std::size_t header = sizeof magic + sizeof(Digest);

}  // namespace

Cache::Cache(std::optional<fs::path> folder) : folder_(std::move(folder)) {
  if (!folder_) return;
  std::error_code error;
  fs::create_directories(*folder_, error);
  if (error)
    throw Error(ErrorCode::config, folder_->string(),
                "the cache folder cannot be made: " + error.message() +
                    "; choose another with --cache DIR, or --cache none");
}

fs::path Cache::file(const Digest& key) const {
  const std::string name = key.hex();
  return *folder_ / name.substr(0, 2) / name.substr(2);
}

std::optional<std::string> Cache::get(const Digest& key) const {
  if (!folder_) return std::nullopt;
  const fs::path path = file(key);
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return std::nullopt;
  std::string bytes;
  try {
    bytes = read_file(path);
  } catch (const Error&) {
    return std::nullopt;  // pruned by another process at this moment
  }
  Digest stored;
  if (bytes.size() >= header && std::memcmp(bytes.data(), magic, sizeof magic) == 0) {
    std::memcpy(&stored, bytes.data() + sizeof magic, sizeof stored);
    bytes.erase(0, header);
    if (digest_bytes(bytes) == stored) return bytes;
  }
  fs::remove(path, error);
  return std::nullopt;
}

void Cache::put(const Digest& key, std::string_view bytes) const {
  if (!folder_) return;
  const fs::path path = file(key);
  fs::create_directories(path.parent_path());
  AtomicFile out(path, AtomicFile::Durability::rename_only);
  const Digest digest = digest_bytes(bytes);
  out.stream().write(magic, sizeof magic);
  out.stream().write(reinterpret_cast<const char*>(&digest), sizeof digest);
  out.stream().write(bytes.data(), std::streamsize(bytes.size()));
  out.commit();
}

fs::path default_cache_folder() {
  if (const char* own = std::getenv("CAMBIUM_CACHE"); own && *own) return own;
  if (const char* xdg = std::getenv("XDG_CACHE_HOME"); xdg && *xdg)
    return fs::path(xdg) / "cambium";
  const char* home = std::getenv("HOME");
  return fs::path(home && *home ? home : "/tmp") / ".cache" / "cambium";
}

}  // namespace cambium
