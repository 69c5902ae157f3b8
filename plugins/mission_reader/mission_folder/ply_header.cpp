// SPDX-License-Identifier: BSD-3-Clause
#include <map>

#include "cloud_header.hpp"

namespace cambium {
namespace {

std::uint64_t ply_size(const std::string& type) {
  static const std::map<std::string, std::uint64_t> sizes = {
      {"char", 1},  {"uchar", 1},  {"short", 2},   {"ushort", 2}, {"int", 4},   {"uint", 4},
      {"float", 4}, {"double", 8}, {"int8", 1},    {"uint8", 1},  {"int16", 2}, {"uint16", 2},
      {"int32", 4}, {"uint32", 4}, {"float32", 4}, {"float64", 8}};
  const auto it = sizes.find(type);
  return it == sizes.end() ? 0 : it->second;
}

}  // namespace

CloudHeader ply_header(std::istream& in, const std::filesystem::path& path) {
  CloudHeader h;
  std::string line, element, format;
  bool has_vertices = false, first = true, complete = false;
  while (!complete && std::getline(in, line)) {
    const auto words = words_of(line);
    if (words.empty()) continue;
    if (words[0] == "format" && words.size() > 1) format = words[1];
    if (words[0] == "element" && words.size() > 2) {
      if (words[1] == "vertex") {
        has_vertices = true;
        h.points = count_in(path, words[2], "element vertex");
        h.sized = h.sized && first;
      }
      element = words[1];
      first = false;
    }
    if (words[0] == "property" && element == "vertex" && words.size() > 2) {
      h.fields.push_back(words.back());
      const std::uint64_t size = words[1] == "list" ? 0 : ply_size(words[1]);
      h.sized = h.sized && size > 0;
      h.bytes_per_point += size;
      ++h.values_per_point;
    }
    complete = words[0] == "end_header";
  }
  if (!complete) refuse(path, "is no PLY file: its header has no end_header line");
  if (!has_vertices) refuse(path, "holds no points: its header has no 'element vertex' line");
  if (format != "ascii" && format != "binary_little_endian" && format != "binary_big_endian")
    refuse(path, "found format '" + format.substr(0, 20) + "', expected ascii or binary_*_endian");
  h.data = format == "ascii" ? CloudHeader::Data::ascii : CloudHeader::Data::binary;
  return h;
}

}  // namespace cambium
