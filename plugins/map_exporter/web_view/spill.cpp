// SPDX-License-Identifier: BSD-3-Clause
#include "spill.hpp"

#include "cambium/error.hpp"

namespace web_view {

ChunkKey chunk_of(const Point& p) {
  return {p.x >> chunk_bits, p.y >> chunk_bits, p.z >> chunk_bits};
}

Spill::Spill(std::filesystem::path file, std::size_t buffered_points)
    : path_(std::move(file)),
      file_(path_, std::ios::binary | std::ios::in | std::ios::out | std::ios::trunc),
      limit_(buffered_points) {}

Spill::~Spill() {
  file_.close();
  std::error_code ignored;
  std::filesystem::remove(path_, ignored);
}

void Spill::add(const Point& point) {
  buffers_[chunk_of(point)].push_back(point);
  if (++buffered_ >= limit_) flush();
}

void Spill::finish() {
  flush();
  file_.flush();
}

void Spill::flush() {
  for (auto& [key, points] : buffers_) {
    file_.write(reinterpret_cast<const char*>(points.data()),
                std::streamsize(points.size() * sizeof(Point)));
    segments_[key].push_back({written_, points.size()});
    written_ += points.size();
  }
  if (!file_)
    throw cambium::Error(cambium::ErrorCode::data, path_.string(),
                         "the points on their way into tiles could not be written; is the disk "
                         "full? TMPDIR names another folder");
  buffers_.clear();
  buffered_ = 0;
}

std::vector<std::pair<ChunkKey, std::size_t>> Spill::chunks() const {
  std::vector<std::pair<ChunkKey, std::size_t>> out;
  for (const auto& [key, segments] : segments_) {
    out.emplace_back(key, 0);
    for (const Segment& s : segments) out.back().second += s.points;
  }
  return out;
}

void Spill::load(const Segment& segment, std::vector<Point>& block) {
  block.resize(segment.points);
  file_.seekg(std::streamoff(segment.first * sizeof(Point)));
  file_.read(reinterpret_cast<char*>(block.data()),
             std::streamsize(block.size() * sizeof(Point)));
  if (!file_)
    throw cambium::Error(cambium::ErrorCode::data, path_.string(),
                         "points that were written before cannot be read back; is the disk sound?");
}

}  // namespace web_view
