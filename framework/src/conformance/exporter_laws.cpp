// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>

#include "cambium/files.hpp"
#include "conformance/law.hpp"

namespace cambium::conformance {
namespace {

namespace fs = std::filesystem;

/// A folder below the context's scratch, removed at the end of its scope.
class Folder {
 public:
  explicit Folder(const Context& context) {
    static std::atomic<int> count{0};
    path_ = context.scratch() / fmt::format("conformance_{}", count++);
    fs::create_directories(path_);
  }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

std::vector<fs::path> write(const Subject& s, const Atlas& atlas, const fs::path& folder,
                            const Context& context) {
  auto files = s.as<MapExporter>().write(atlas, folder, context);
  for (const fs::path& file : files) {
    require(fs::exists(file), fmt::format("names '{}' as written; it is not there", file.string()));
    const fs::path relative = fs::relative(file, folder);
    require(!relative.empty() && *relative.begin() != "..",
            fmt::format("wrote '{}', which is outside of its folder", file.string()));
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::string bytes_of(const Subject& s, const Atlas& atlas, const Context& context) {
  const Folder folder(context);
  std::string out;
  for (const fs::path& file : write(s, atlas, folder.path(), context)) {
    out += fs::relative(file, folder.path()).string() + '\n';
    if (fs::is_regular_file(file)) out += read_file(file);
  }
  return out;
}

// A file of several missions has more than one answer: a reader may want to be told which, which is
// a mistake of the configuration and none of the file.
std::optional<Mission> read_without_being_told(const MissionReader& reader, const fs::path& file,
                                               const Context& context) {
  try {
    return reader.read(file, context);
  } catch (const Error& e) {
    if (e.code() != ErrorCode::config) throw;
    return std::nullopt;
  }
}

void reads_back(const Subject& s) {
  const Host host(1);
  const auto context = host.context();
  const Folder folder(*context);
  std::size_t read = 0;
  for (const fs::path& file : write(s, s.world.atlas, folder.path(), *context))
    for (const auto& [key, registered] : s.registry.all()) {
      if (registered.kind != Kind::mission_reader) continue;
      const auto component = registered.create();
      const auto& reader = dynamic_cast<const MissionReader&>(*component);
      if (!reader.accepts(file)) continue;
      const auto mission = read_without_being_told(reader, file, *context);
      if (!mission) continue;
      require(!mission->nodes.empty(),
              fmt::format("'{}' reads back without nodes", file.filename().string()));
      ++read;
    }
  if (read == 0) throw NotApplicable("no mission reader accepts what it writes");
}

}  // namespace

Exercise exercise_exporter(const Subject& s) {
  Exercise e;
  e.usual = [&s](const Context& c) { return bytes_of(s, s.world.atlas, c); };
  for (const OddPayload& odd : odd_payloads())
    e.odd.emplace_back("missions of " + odd.name, [&s, odd](const Context& c) {
      return bytes_of(
          s, with_payloads(s.world.atlas, [&odd](NodeRef, const Payload&) { return odd.payload; }),
          c);
    });
  e.odd.emplace_back("missions of one node", [&s](const Context& c) {
    return bytes_of(s, first_nodes(s.world.atlas, 1), c);
  });
  e.own = {{"writes what a reader reads back", reads_back}};
  return e;
}

}  // namespace cambium::conformance
