// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cache_upkeep.hpp"

#include <algorithm>

#include "cambium/error.hpp"
#include "cambium/files.hpp"
#include "engine/cache_entry.hpp"
#include "io/temporary.hpp"

namespace cambium {
namespace {

namespace fs = std::filesystem;

// An entry lies at xx/yyyy..., 2 and 30 hexadecimal digits; anything else is not ours to touch.
bool is_entry(const fs::path& path) {
  const std::string name = path.parent_path().filename().string() + path.filename().string();
  return name.size() == 32 && name.find_first_not_of("0123456789abcdef") == std::string::npos;
}

// Other processes add and remove files meanwhile, so nothing here may rely on a file that was seen.
template <class Visit>
void for_each_file(const fs::path& folder, Visit visit) {
  std::error_code gone;
  for (const auto& sub : fs::directory_iterator(folder, gone))
    for (const auto& file : fs::directory_iterator(sub.path(), gone)) visit(file.path());
}

void add(CacheGroup& group, const CachedFile& file, double seconds) {
  group.newest = group.entries == 0 ? file.unused : std::min(group.newest, file.unused);
  group.oldest = std::max(group.oldest, file.unused);
  group.bytes += file.bytes;
  group.seconds += seconds;
  ++group.entries;
}

// A writer takes milliseconds; after an hour nobody will rename the file any more.
void remove_leftovers(const fs::path& folder) {
  for_each_file(folder, [](const fs::path& file) {
    std::error_code gone;
    const auto age = fs::file_time_type::clock::now() - fs::last_write_time(file, gone);
    if (!gone && is_temporary(file) && age > std::chrono::hours(1)) fs::remove(file, gone);
  });
}

}  // namespace

std::vector<CachedFile> cached_files(const fs::path& folder) {
  if (!fs::is_directory(folder))
    throw Error(ErrorCode::config, folder.string(), "is no cache folder; name one with --cache");
  const auto now = fs::file_time_type::clock::now();
  std::vector<CachedFile> out;
  for_each_file(folder, [&](const fs::path& path) {
    std::error_code gone;
    const auto bytes = fs::file_size(path, gone);
    const auto used = fs::last_write_time(path, gone);
    if (!gone && is_entry(path))
      out.push_back({path, bytes, std::chrono::duration_cast<std::chrono::seconds>(now - used)});
  });
  std::sort(out.begin(), out.end(), [](const CachedFile& a, const CachedFile& b) {
    return std::tie(b.unused, a.path) < std::tie(a.unused, b.path);
  });
  return out;
}

std::map<std::string, CacheGroup> cache_by_kind(const fs::path& folder) {
  std::map<std::string, CacheGroup> out;
  for (const CachedFile& file : cached_files(folder)) {
    std::ifstream in(file.path, std::ios::binary);
    if (!in) continue;  // pruned meanwhile
    std::string head(head_size, '\0');
    in.read(head.data(), std::streamsize(head.size()));
    head.resize(std::size_t(in.gcount()));
    const auto entry = unpack_head(head);
    add(out[entry ? entry->kind : "damaged"], file, entry ? entry->seconds : 0);
  }
  return out;
}

std::vector<fs::path> remove_damaged(const fs::path& folder) {
  std::vector<fs::path> out;
  for (const CachedFile& file : cached_files(folder)) {
    std::error_code gone;
    try {
      if (unpack(read_file(file.path))) continue;
    } catch (const Error&) {
      if (!fs::exists(file.path, gone)) continue;  // pruned meanwhile
    }
    out.push_back(file.path);
    fs::remove(file.path, gone);
  }
  return out;
}

std::size_t adopt_entries(const fs::path& from, const fs::path& into) {
  std::size_t count = 0;
  for (const CachedFile& file : cached_files(from)) {
    const fs::path target = into / fs::relative(file.path, from);
    if (fs::exists(target)) continue;
    const std::string bytes = read_file(file.path);
    if (!unpack(bytes)) continue;
    fs::create_directories(target.parent_path());
    AtomicFile out(target, AtomicFile::Durability::rename_only);
    out.stream().write(bytes.data(), std::streamsize(bytes.size()));
    out.commit();
    ++count;
  }
  return count;
}

Pruned prune_cache(const fs::path& folder, const PruneLimits& limits) {
  const auto files = cached_files(folder);
  Pruned out;
  for (const CachedFile& file : files) out.kept_bytes += file.bytes;
  for (const CachedFile& file : files) {
    const bool old = limits.unused && file.unused > *limits.unused;
    const bool too_much = limits.bytes && out.kept_bytes > *limits.bytes;
    if (!old && !too_much) {
      ++out.kept;
      continue;
    }
    std::error_code gone;
    fs::remove(file.path, gone);
    ++out.removed;
    out.removed_bytes += file.bytes;
    out.kept_bytes -= file.bytes;
  }
  remove_leftovers(folder);
  return out;
}

}  // namespace cambium
