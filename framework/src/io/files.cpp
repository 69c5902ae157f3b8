// SPDX-License-Identifier: BSD-3-Clause
#include "cambium/files.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <sstream>

#include "cambium/error.hpp"
#include "io/temporary.hpp"

namespace cambium {
namespace {

std::string system_message() { return std::strerror(errno); }

void sync_to_disk(const std::filesystem::path& path) {
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0) throw Error(ErrorCode::data, path.string(), "cannot be synced: " + system_message());
  const bool ok = ::fsync(fd) == 0;
  ::close(fd);
  if (!ok) throw Error(ErrorCode::data, path.string(), "cannot be synced: " + system_message());
}

}  // namespace

std::string read_file(const std::filesystem::path& path) {
  if (std::filesystem::is_directory(path))
    throw Error(ErrorCode::data, path.string(), "is a folder, expected a file");
  std::ifstream in(path, std::ios::binary | std::ios::ate);
  if (!in)
    throw Error(ErrorCode::data, path.string(),
                "cannot be opened for reading: " + system_message());
  std::string text(std::size_t(in.tellg()), '\0');
  in.seekg(0);
  if (!in.read(text.data(), std::streamsize(text.size())))
    throw Error(ErrorCode::data, path.string(), "cannot be read to its end: " + system_message());
  return text;
}

AtomicFile::AtomicFile(std::filesystem::path path, Durability durability)
    : path_(std::move(path)), temporary_(temporary_name(path_)), durability_(durability) {
  out_.open(temporary_, std::ios::binary);
  if (!out_) throw Error(ErrorCode::data, path_.string(), "cannot be written: " + system_message());
}

AtomicFile::~AtomicFile() {
  if (committed_) return;
  std::error_code ignored;
  out_.close();
  std::filesystem::remove(temporary_, ignored);
}

void AtomicFile::commit() {
  out_.close();
  if (!out_) throw Error(ErrorCode::data, path_.string(), "cannot be written: " + system_message());
  if (durability_ == Durability::synced) sync_to_disk(temporary_);
  std::error_code error;
  std::filesystem::rename(temporary_, path_, error);
  if (error) throw Error(ErrorCode::data, path_.string(), "cannot be written: " + error.message());
  committed_ = true;
}

void write_file(const std::filesystem::path& path, std::string_view text) {
  AtomicFile file(path);
  file.stream() << text;
  file.commit();
}

}  // namespace cambium
