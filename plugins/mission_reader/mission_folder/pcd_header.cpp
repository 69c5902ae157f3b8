// SPDX-License-Identifier: BSD-3-Clause
#include <map>
#include <set>

#include "cloud_header.hpp"

namespace cambium {

namespace {

using Keys = std::map<std::string, std::vector<std::string>>;

// https://pointclouds.org/documentation/tutorials/pcd_file_format.html
Keys read_keys(std::istream& in, const std::filesystem::path& path) {
  static const std::set<std::string> known = {"VERSION", "FIELDS", "SIZE",      "TYPE",   "COUNT",
                                              "WIDTH",   "HEIGHT", "VIEWPOINT", "POINTS", "DATA"};
  Keys keys;
  for (std::string line; !keys.contains("DATA") && std::getline(in, line);) {
    const auto words = words_of(line);
    if (words.empty() || words[0][0] == '#') continue;
    if (!known.contains(words[0]))
      refuse(path, "is no PCD file, or damaged: its header has an unknown line");
    keys[words[0]] = {words.begin() + 1, words.end()};
  }
  for (const char* key : {"FIELDS", "SIZE", "TYPE", "WIDTH", "HEIGHT", "DATA"})
    if (keys[key].empty())
      refuse(path, std::string("is no PCD file: its header has no ") + key + " line");
  return keys;
}

CloudHeader::Data encoding(const std::string& word, const std::filesystem::path& path) {
  if (word == "ascii") return CloudHeader::Data::ascii;
  if (word == "binary") return CloudHeader::Data::binary;
  if (word == "binary_compressed") return CloudHeader::Data::compressed;
  refuse(path,
         "found DATA '" + word.substr(0, 20) + "', expected ascii, binary or binary_compressed");
}

}  // namespace

CloudHeader pcd_header(std::istream& in, const std::filesystem::path& path) {
  Keys keys = read_keys(in, path);
  CloudHeader h;
  h.fields = keys["FIELDS"];
  static const std::set<std::string> type_sizes = {"F4", "F8", "U1", "U2", "U4",
                                                   "U8", "I1", "I2", "I4", "I8"};
  const auto &size = keys["SIZE"], &type = keys["TYPE"], &count = keys["COUNT"];
  if (size.size() != h.fields.size() || type.size() != h.fields.size() ||
      (!count.empty() && count.size() != h.fields.size()))
    refuse(path, "FIELDS, SIZE, TYPE and COUNT of the header have different lengths");
  for (std::size_t i = 0; i < size.size(); ++i) {
    if (!type_sizes.contains(type[i] + size[i]))
      refuse(path, "found TYPE " + type[i].substr(0, 20) + " of SIZE " + size[i].substr(0, 20) +
                       ", expected F 4 8, U 1 2 4 8 or I 1 2 4 8");
    const std::uint64_t values = count.empty() ? 1 : count_in(path, count[i], "COUNT");
    h.values_per_point += values;
    h.bytes_per_point += values * count_in(path, size[i], "SIZE");
  }
  h.points =
      count_in(path, keys["WIDTH"][0], "WIDTH") * count_in(path, keys["HEIGHT"][0], "HEIGHT");
  if (!keys["POINTS"].empty() && count_in(path, keys["POINTS"][0], "POINTS") != h.points)
    refuse(path, "the header says POINTS " + keys["POINTS"][0] + ", but WIDTH x HEIGHT is " +
                     std::to_string(h.points));
  h.data = encoding(keys["DATA"][0], path);
  return h;
}

}  // namespace cambium
