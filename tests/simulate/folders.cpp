// SPDX-License-Identifier: BSD-3-Clause
#include "simulate/folders.hpp"

#include <sstream>

#include "simulate/spec_file.hpp"
#include "support/places.hpp"

namespace cambium::simulate {
namespace {

std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> out;
  std::istringstream in(line);
  for (std::string cell; std::getline(in, cell, ',');) out.push_back(cell);
  return out;
}

}  // namespace

Simulated::Simulated(const std::string& name, int threads) {
  const std::filesystem::path file = testing::source("tests/specs/" + name + ".yaml");
  spec = load_spec(file);
  summary = simulate(spec, read_file(file), folder_.path(), *testing::make_context(threads));
}

Mission Simulated::mission(const std::string& name) const {
  const auto reader = testing::component<MissionReader>("mission_folder", "{check_payloads: true}");
  return reader->read(path(name), *testing::make_context());
}

std::vector<StampedPose> Simulated::truth(const std::string& mission) const {
  return read_tum(path(mission) / "ground_truth.tum");
}

std::vector<std::map<std::string, std::string>> Simulated::table(const std::string& file) const {
  std::istringstream in(read_file(path(file)));
  std::string line;
  std::getline(in, line);
  const auto header = cells(line);
  std::vector<std::map<std::string, std::string>> out;
  while (std::getline(in, line)) {
    const auto row = cells(line);
    out.emplace_back();
    for (std::size_t i = 0; i < header.size(); ++i) out.back()[header[i]] = row.at(i);
  }
  return out;
}

std::map<std::string, std::string> contents(const std::filesystem::path& folder) {
  std::map<std::string, std::string> out;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.is_regular_file())
      out[std::filesystem::relative(entry.path(), folder).string()] = read_file(entry.path());
  return out;
}

}  // namespace cambium::simulate
