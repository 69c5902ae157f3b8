// SPDX-License-Identifier: BSD-3-Clause
#include "fingerprint.hpp"

#include <cstring>
#include <type_traits>

namespace tree_match {
namespace {

using cambium::Error;
using cambium::Fingerprints;

// All rows are numbers without padding, so their bytes say all and can be hashed.
static_assert(sizeof(cambium::SE3) == 7 * sizeof(double) || sizeof(cambium::SE3) == 64);
static_assert(sizeof(Stem) == 28);

class Writer {
 public:
  template <class T>
  void rows(const std::vector<T>& rows) {
    bytes_of(rows.size());
    const auto* data = reinterpret_cast<const std::byte*>(rows.data());
    out.insert(out.end(), data, data + rows.size() * sizeof(T));
  }
  std::vector<std::byte> out;

 private:
  void bytes_of(std::uint64_t count) {
    const auto* data = reinterpret_cast<const std::byte*>(&count);
    out.insert(out.end(), data, data + sizeof(count));
  }
};

class Reader {
 public:
  explicit Reader(const std::vector<std::byte>& bytes) : bytes_(bytes) {}

  template <class T>
  std::vector<T> rows() {
    std::uint64_t count = 0;
    take(&count, sizeof(count));
    if (count > bytes_.size() / sizeof(T)) fail();
    std::vector<T> out(count);
    take(out.data(), count * sizeof(T));
    return out;
  }
  void finish() const {
    if (at_ != bytes_.size()) fail();
  }

 private:
  void take(void* to, std::size_t size) {
    if (size > bytes_.size() - at_) fail();
    if (size > 0) std::memcpy(to, bytes_.data() + at_, size);
    at_ += size;
  }
  [[noreturn]] static void fail() {
    throw Error(cambium::ErrorCode::data, "tree_match",
                "these fingerprints are not of this recogniser; describe the mission again");
  }

  const std::vector<std::byte>& bytes_;
  std::size_t at_ = 0;
};

}  // namespace

Fingerprints to_fingerprints(const Place& place) {
  Writer writer;
  writer.rows(place.T_mission_node);
  writer.rows(place.path);
  writer.rows(place.stems);
  writer.rows(place.triangles);
  writer.rows(place.detections);
  writer.rows(place.begin);
  return {place.T_mission_node.size(), 0, {}, std::move(writer.out)};
}

Place from_fingerprints(const Fingerprints& fingerprints) {
  Reader reader(fingerprints.extra);
  Place place;
  place.T_mission_node = reader.rows<cambium::SE3>();
  place.path = reader.rows<double>();
  place.stems = reader.rows<Stem>();
  place.triangles = reader.rows<Triangle>();
  place.detections = reader.rows<Stem>();
  place.begin = reader.rows<std::uint64_t>();
  reader.finish();
  return place;
}

}  // namespace tree_match
