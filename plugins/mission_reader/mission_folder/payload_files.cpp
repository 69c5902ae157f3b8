// SPDX-License-Identifier: BSD-3-Clause
#include "payload_files.hpp"

#include <algorithm>
#include <charconv>
#include <optional>

#include "cambium/error.hpp"

namespace cambium {
namespace {

namespace fs = std::filesystem;

// Loggers pad the nanoseconds to 9 digits; as integers padded and plain ones are the same.
std::optional<Stamp> stamp_in_name(const std::string& stem, const std::string& prefix) {
  if (!stem.starts_with(prefix + "_")) return std::nullopt;
  const char* const end = stem.data() + stem.size();
  Stamp stamp;
  const auto sec = std::from_chars(stem.data() + prefix.size() + 1, end, stamp.sec);
  if (sec.ec != std::errc{} || sec.ptr == end || *sec.ptr != '_') return std::nullopt;
  const auto nsec = std::from_chars(sec.ptr + 1, end, stamp.nsec);
  if (nsec.ec != std::errc{} || nsec.ptr != end) return std::nullopt;
  if (stamp.sec < 0 || stamp.nsec < 0 || stamp.nsec > 999'999'999) return std::nullopt;
  return stamp;
}

std::vector<fs::path> sorted_files(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> out;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
    if (it->path().filename().string()[0] != '.') out.push_back(it->path());
  if (error)
    throw Error(ErrorCode::data, folder.string(), "cannot be read as a folder: " + error.message());
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace

StampedFiles find_stamped_files(const fs::path& folder, const std::string& prefix,
                                const std::vector<std::string>& extensions,
                                std::vector<std::string>& warnings) {
  StampedFiles out;
  out.folder = folder;
  std::vector<std::string> twice;
  const auto files = sorted_files(folder);
  for (const std::string& extension : extensions)
    for (const fs::path& path : files) {
      const auto stamp = stamp_in_name(path.stem().string(), prefix);
      if (path.extension() != extension || !stamp) continue;
      if (!out.by_stamp.emplace(*stamp, path).second) twice.push_back(path.filename().string());
    }
  if (!twice.empty())
    warnings.push_back(
        folder.string() + ": " +
        with_first_names("files are left out, there is another one of their stamp", twice));
  for (const fs::path& path : files)
    if (!stamp_in_name(path.stem().string(), prefix) ||
        std::find(extensions.begin(), extensions.end(), path.extension()) == extensions.end())
      out.unnamed.push_back(path.filename().string());
  return out;
}

std::string with_first_names(const std::string& what, const std::vector<std::string>& names) {
  std::string out = std::to_string(names.size()) + " " + what + ":";
  for (std::size_t i = 0; i < std::min<std::size_t>(3, names.size()); ++i) out += " " + names[i];
  return names.size() > 3 ? out + " ..." : out;
}

std::set<Stamp> shared_stamps(const Mission& mission, std::vector<std::string>& warnings) {
  std::set<Stamp> once, shared;
  for (const Node& node : mission.nodes)
    if (node.stamp && !once.insert(*node.stamp).second) shared.insert(*node.stamp);
  std::vector<std::string> nodes;
  for (const Node& node : mission.nodes)
    if (node.stamp && shared.contains(*node.stamp)) nodes.push_back(std::to_string(node.id));
  if (!nodes.empty())
    warnings.push_back(
        mission.graph_file.string() + ": " +
        with_first_names("nodes share their stamp with another one, so that it is not known whose "
                         "the files of that stamp are; these nodes get none",
                         nodes));
  return shared;
}

void report_mismatch(const Mission& mission, const StampedFiles& files, const std::string& what,
                     std::vector<std::string>& warnings) {
  std::set<Stamp> stamps;
  std::vector<std::string> without, strangers = files.unnamed;
  for (const Node& node : mission.nodes) {
    if (node.stamp) stamps.insert(*node.stamp);
    if (!node.stamp || !files.by_stamp.contains(*node.stamp))
      without.push_back(node.stamp ? std::to_string(node.stamp->sec) + "_" +
                                         std::to_string(node.stamp->nsec)
                                   : "node " + std::to_string(node.id) + " (no stamp)");
  }
  for (const auto& [stamp, path] : files.by_stamp)
    if (!stamps.contains(stamp)) strangers.push_back(path.filename().string());
  const std::string folder = files.folder.string() + ": ";
  if (!without.empty())
    warnings.push_back(folder + with_first_names("of " + std::to_string(mission.nodes.size()) +
                                                     " nodes have no " + what,
                                                 without));
  if (!strangers.empty())
    warnings.push_back(folder + with_first_names("files belong to no node", strangers));
}

}  // namespace cambium
