// SPDX-License-Identifier: BSD-3-Clause
#include "cloud_header.hpp"

#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>
#include <vector>

#include "cambium/error.hpp"

namespace cambium {
namespace {

using Path = std::filesystem::path;

struct Header {
  std::uint64_t points = 0, bytes_per_point = 0;
  enum class Data { ascii, binary, compressed } data = Data::ascii;
  bool sized = false;  ///< bytes_per_point tells where the points end
  std::vector<std::string> fields;
};

[[noreturn]] void fail(const Path& path, const std::string& what) {
  throw Error(ErrorCode::data, path.string(), what);
}

std::vector<std::string> words_of(const std::string& line) {
  std::istringstream in(line);
  std::vector<std::string> out;
  for (std::string word; in >> word;) out.push_back(word);
  return out;
}

std::uint64_t count_in(const Path& path, const std::string& text, const std::string& what) {
  if (text.empty() || text.size() > 12 || text.find_first_not_of("0123456789") != text.npos)
    fail(path, "found " + what + " '" + text.substr(0, 20) + "', expected a number");
  return std::stoull(text);
}

// The keys of the format: https://pointclouds.org/documentation/tutorials/pcd_file_format.html
Header pcd_header(std::istream& in, const Path& path) {
  std::map<std::string, std::vector<std::string>> keys;
  for (std::string line; !keys.contains("DATA") && std::getline(in, line);) {
    auto words = words_of(line);
    if (words.empty() || words[0][0] == '#') continue;
    const std::string key = words[0];
    if (key.size() > 20) fail(path, "is no PCD file: its header has a line that is none");
    keys[key] = {words.begin() + 1, words.end()};
  }
  for (const char* key : {"FIELDS", "SIZE", "TYPE", "WIDTH", "HEIGHT", "DATA"})
    if (keys[key].empty())
      fail(path, std::string("is no PCD file: its header has no ") + key + " line");
  Header h;
  h.fields = keys["FIELDS"];
  const auto &size = keys["SIZE"], &count = keys["COUNT"];
  if (size.size() != h.fields.size() || keys["TYPE"].size() != h.fields.size() ||
      (!count.empty() && count.size() != h.fields.size()))
    fail(path, "FIELDS, SIZE, TYPE and COUNT of the header have different lengths");
  for (std::size_t i = 0; i < size.size(); ++i)
    h.bytes_per_point +=
        count_in(path, size[i], "SIZE") * (count.empty() ? 1 : count_in(path, count[i], "COUNT"));
  h.points =
      count_in(path, keys["WIDTH"][0], "WIDTH") * count_in(path, keys["HEIGHT"][0], "HEIGHT");
  if (!keys["POINTS"].empty() && count_in(path, keys["POINTS"][0], "POINTS") != h.points)
    fail(path, "the header says POINTS " + keys["POINTS"][0] + ", but WIDTH x HEIGHT is " +
                   std::to_string(h.points));
  const std::string& data = keys["DATA"][0];
  if (data != "ascii" && data != "binary" && data != "binary_compressed")
    fail(path,
         "found DATA '" + data.substr(0, 20) + "', expected ascii, binary or binary_compressed");
  h.data = data == "ascii"    ? Header::Data::ascii
           : data == "binary" ? Header::Data::binary
                              : Header::Data::compressed;
  h.sized = true;
  return h;
}

std::uint64_t ply_size(const std::string& type) {
  static const std::map<std::string, std::uint64_t> sizes = {
      {"char", 1},  {"uchar", 1},  {"short", 2},   {"ushort", 2}, {"int", 4},   {"uint", 4},
      {"float", 4}, {"double", 8}, {"int8", 1},    {"uint8", 1},  {"int16", 2}, {"uint16", 2},
      {"int32", 4}, {"uint32", 4}, {"float32", 4}, {"float64", 8}};
  const auto it = sizes.find(type);
  return it == sizes.end() ? 0 : it->second;
}

Header ply_header(std::istream& in, const Path& path) {
  Header h;
  std::string line, element, format;
  bool has_vertices = false, first = true, complete = false;
  h.sized = true;
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
    }
    complete = words[0] == "end_header";
  }
  if (!complete) fail(path, "is no PLY file: its header has no end_header line");
  if (!has_vertices) fail(path, "holds no points: its header has no 'element vertex' line");
  if (format != "ascii" && format != "binary_little_endian" && format != "binary_big_endian")
    fail(path, "found format '" + format.substr(0, 20) + "', expected ascii or binary_*_endian");
  h.data = format == "ascii" ? Header::Data::ascii : Header::Data::binary;
  return h;
}

std::uint64_t ascii_rows(std::istream& in) {
  std::uint64_t rows = 0;
  for (std::string line; std::getline(in, line);)
    rows += line.find_first_not_of(" \t\r") != line.npos && line[0] != '#';
  return rows;
}

void check_body(std::istream& in, const Header& h, const Path& path, bool may_hold_more) {
  if (!h.sized || h.data == Header::Data::compressed) return;
  std::uint64_t found = 0;
  if (h.data == Header::Data::ascii) {
    found = ascii_rows(in);
  } else {
    const auto begin = std::uint64_t(in.tellg());
    found =
        (std::filesystem::file_size(path) - begin) / std::max<std::uint64_t>(1, h.bytes_per_point);
  }
  const bool more = found > h.points && !may_hold_more;
  if (found < h.points || more)
    fail(path, "the header promises " + std::to_string(h.points) + " points, the file holds " +
                   std::to_string(found) + "; it is truncated or its header is wrong");
}

}  // namespace

std::uint64_t checked_point_count(const Path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) fail(path, "cannot be opened for reading");
  std::string magic(5, '\0');
  in.read(magic.data(), 5);
  if (in.gcount() == 0) fail(path, "is an empty file, expected a point cloud");
  in.clear();
  in.seekg(0);
  const bool is_ply = path.extension() == ".ply";
  if (is_ply && !magic.starts_with("ply"))
    fail(path, "is no PLY file: it does not begin with 'ply'");
  const Header h = is_ply ? ply_header(in, path) : pcd_header(in, path);
  for (const char* name : {"x", "y", "z"})
    if (std::find(h.fields.begin(), h.fields.end(), name) == h.fields.end())
      fail(path, std::string("has no field '") + name + "', expected at least x, y and z");
  check_body(in, h, path, is_ply);  // faces may follow the vertices of a PLY file
  return h.points;
}

}  // namespace cambium
