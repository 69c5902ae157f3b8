// SPDX-License-Identifier: BSD-3-Clause
#include "cloud_header.hpp"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <sstream>

#include "cambium/error.hpp"

namespace cambium {
namespace {

using Path = std::filesystem::path;

// PCL takes a word that is no number as zero.
bool is_number(const std::string& word) {
  double value = 0;
  const char* begin = word.data() + (word[0] == '+' ? 1 : 0);
  const auto [end, error] = std::from_chars(begin, word.data() + word.size(), value);
  return error == std::errc{} && end == word.data() + word.size();
}

std::uint64_t ascii_rows(std::istream& in, const CloudHeader& h, const Path& path) {
  std::uint64_t rows = 0;
  for (std::string line; std::getline(in, line);) {
    const auto words = words_of(line);
    if (words.empty() || words[0][0] == '#') continue;
    if (++rows > h.points) continue;  // counted, to tell how many are too many
    const bool numbers = std::all_of(words.begin(), words.end(), is_number);
    if (!numbers || words.size() != h.values_per_point)
      refuse(path, "point " + std::to_string(rows) + " is not of " +
                       std::to_string(h.values_per_point) + " numbers, as the header promises");
  }
  return rows;
}

std::uint64_t binary_rows(std::istream& in, const CloudHeader& h, const Path& path) {
  const auto begin = std::uint64_t(in.tellg());
  return (std::filesystem::file_size(path) - begin) / std::max<std::uint64_t>(1, h.bytes_per_point);
}

// The block begins with its two sizes, 32 bits each in the order of this machine. PCL trusts them.
void check_compressed(std::istream& in, const CloudHeader& h, const Path& path) {
  const auto rest = std::filesystem::file_size(path) - std::uint64_t(in.tellg());
  std::uint32_t sizes[2] = {0, 0};
  in.read(reinterpret_cast<char*>(sizes), sizeof sizes);
  if (in && sizes[0] + sizeof sizes <= rest && sizes[1] == h.points * h.bytes_per_point) return;
  refuse(path, "the compressed block is truncated or damaged, expected " +
                   std::to_string(h.points) + " points of " + std::to_string(h.bytes_per_point) +
                   " bytes");
}

void check_body(std::istream& in, const CloudHeader& h, const Path& path, bool may_hold_more) {
  if (!h.sized) return;
  if (h.data == CloudHeader::Data::compressed) return check_compressed(in, h, path);
  const std::uint64_t found =
      h.data == CloudHeader::Data::ascii ? ascii_rows(in, h, path) : binary_rows(in, h, path);
  if (found < h.points || (found > h.points && !may_hold_more))
    refuse(path, "the header promises " + std::to_string(h.points) + " points, the file holds " +
                     std::to_string(found) + "; it is truncated or its header is wrong");
}

}  // namespace

void refuse(const Path& path, const std::string& what) {
  throw Error(ErrorCode::data, path.string(), what);
}

std::vector<std::string> words_of(const std::string& line) {
  std::istringstream in(line);
  std::vector<std::string> out;
  for (std::string word; in >> word;) out.push_back(word);
  return out;
}

std::uint64_t count_in(const Path& path, const std::string& text, const std::string& what) {
  if (text.empty() || text.size() > 10 || text.find_first_not_of("0123456789") != text.npos)
    refuse(path, "found " + what + " '" + text.substr(0, 20) + "', expected a number");
  return std::stoull(text);
}

std::uint64_t checked_point_count(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) refuse(path, "cannot be opened for reading");
  std::string magic(5, '\0');
  in.read(magic.data(), 5);
  if (in.gcount() == 0) refuse(path, "is an empty file, expected a point cloud");
  in.clear();
  in.seekg(0);
  const bool is_ply = path.extension() == ".ply";
  if (is_ply && !magic.starts_with("ply"))
    refuse(path, "is no PLY file: it does not begin with 'ply'");
  const CloudHeader h = is_ply ? ply_header(in, path) : pcd_header(in, path);
  for (const char* name : {"x", "y", "z"})
    if (std::find(h.fields.begin(), h.fields.end(), name) == h.fields.end())
      refuse(path, std::string("has no field '") + name + "', expected at least x, y and z");
  check_body(in, h, path, is_ply);  // faces may follow the vertices of a PLY file
  return h.points;
}

}  // namespace cambium
