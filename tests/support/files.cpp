// SPDX-License-Identifier: BSD-3-Clause
#include <stdlib.h>

#include <cstdlib>
#include <fstream>

#include "support/places.hpp"
#include "support/support.hpp"

namespace cambium::testing {
namespace {

namespace fs = std::filesystem;

fs::path new_folder(const fs::path& parent) {
  std::string name = (parent / "cambium-XXXXXX").string();
  if (!::mkdtemp(name.data()))
    throw Error(ErrorCode::data, parent.string(), "no folder can be made in it");
  return name;
}

fs::path shared_data_folder() {
  const char* named = std::getenv("CAMBIUM_SHARED_DATA");
  return named ? fs::path(named) : source("../shared/data");
}

std::string quoted(const fs::path& path) {
  std::string out = "'";
  for (const char c : path.string()) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

// The name changes with the archive, so that a new archive is not hidden by an old copy.
fs::path unpacked_name(const fs::path& archive) {
  const auto time = fs::last_write_time(archive).time_since_epoch().count();
  Hasher key;
  key.add(fs::canonical(archive).string()).add(fs::file_size(archive)).add(std::uint64_t(time));
  return fs::temp_directory_path() /
         ("cambium-data-" + archive.stem().stem().string() + "-" + key.digest().hex().substr(0, 8));
}

// Several tests may unpack at once: the first rename wins, the others take what is there.
void unpack(const fs::path& archive, const fs::path& target) {
  const fs::path temporary = new_folder(target.parent_path());
  const std::string command = "tar -xJf " + quoted(archive) + " -C " + quoted(temporary);
  if (std::system(command.c_str()) != 0) {
    fs::remove_all(temporary);
    throw Error(ErrorCode::data, archive.string(), "cannot be unpacked with `" + command + "`");
  }
  std::error_code taken;
  fs::rename(temporary, target, taken);
  if (taken) fs::remove_all(temporary);
}

}  // namespace

TemporaryFolder::TemporaryFolder() : path_(new_folder(fs::temp_directory_path())) {}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

fs::path real_data(const std::string& archive) {
  const fs::path file = shared_data_folder() / (archive + ".tar.xz");
  if (!fs::exists(file)) return {};
  const fs::path target = unpacked_name(file);
  if (!fs::exists(target)) unpack(file, target);
  for (const auto& entry : fs::directory_iterator(target))
    if (entry.is_directory()) return entry.path();
  throw Error(ErrorCode::data, file.string(), "holds no folder; see the README beside it");
}

}  // namespace cambium::testing
