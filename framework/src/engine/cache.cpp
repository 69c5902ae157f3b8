// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cache.hpp"

#include <chrono>
#include <cstdlib>

#include "cambium/error.hpp"
#include "cambium/files.hpp"

namespace cambium {
namespace {

namespace fs = std::filesystem;

void make_folder(const fs::path& folder, ErrorCode code) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    throw Error(code, folder.string(),
                "the cache folder cannot be made: " + error.message() +
                    "; choose another with --cache DIR, or --cache none");
}

// Pruning goes by the time of last use. An hour is fine enough, and spares most hits the write.
void note_use(const fs::path& file) {
  std::error_code ignored;
  const auto now = fs::file_time_type::clock::now();
  if (now - fs::last_write_time(file, ignored) > std::chrono::hours(1))
    fs::last_write_time(file, now, ignored);
}

}  // namespace

Cache::Cache(std::optional<fs::path> folder, Warn warn)
    : folder_(std::move(folder)), warn_(std::move(warn)) {
  if (folder_) make_folder(*folder_, ErrorCode::config);
}

fs::path Cache::file(const Digest& key) const {
  const std::string name = key.hex();
  return *folder_ / name.substr(0, 2) / name.substr(2);
}

std::optional<CacheEntry> Cache::get(const Digest& key) const {
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
  auto entry = unpack(bytes);
  if (entry) {
    note_use(path);
  } else {
    fs::remove(path, error);
    if (warn_)
      warn_(path.string() +
            ": the content does not fit its digest; the entry is removed and computed again");
  }
  return entry;
}

void Cache::put(const Digest& key, const CacheEntry& entry) const {
  if (!folder_) return;
  const fs::path path = file(key);
  make_folder(path.parent_path(), ErrorCode::data);
  AtomicFile out(path, AtomicFile::Durability::rename_only);
  const std::string bytes = pack(entry);
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
