// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "conformance/law.hpp"

namespace cambium::conformance {
namespace {

std::string bytes_of(const Payload& p) {
  std::string out;
  if (p.cloud) {
    const Cloud& c = *p.cloud;
    require(c.xyz.size() % 3 == 0, fmt::format("{} coordinates; expected 3 a point", c.xyz.size()));
    require(c.normals.empty() || c.normals.size() == c.xyz.size(),
            fmt::format("{} normals' coordinates for {} points", c.normals.size(), c.size()));
    require(c.intensity.empty() || c.intensity.size() == c.size(),
            fmt::format("{} intensities for {} points", c.intensity.size(), c.size()));
    require(c.label.empty() || c.label.size() == c.size(),
            fmt::format("{} labels for {} points", c.label.size(), c.size()));
    out += encode(c.xyz) + encode(c.normals) + encode(c.intensity) + encode(c.label);
  }
  if (!p.trees) return out;
  for (const Tree& t : *p.trees) {
    out +=
        encode(t.base) + encode(t.axis) + encode(t.dbh) + encode(t.score) + encode(t.reconstructed);
  }
  return out;
}

std::string apply(const Subject& s, const Atlas& atlas, const Context& context) {
  std::string out;
  for (std::uint32_t m = 0; m < atlas.missions.size(); ++m)
    for (std::size_t i = 0; i < std::min<std::size_t>(3, atlas.missions[m].mission->nodes.size());
         ++i) {
      const Payload before = atlas.payload({m, std::uint32_t(i)});
      const std::string input = before.cloud ? encode(before.cloud->xyz) : "";
      out += bytes_of(s.as<PayloadFilter>().apply({atlas, m}, i, context));
      require(!before.cloud || encode(before.cloud->xyz) == input,
              "changed its input; payloads are shared, return a new one");
    }
  return out;
}

}  // namespace

Exercise exercise_filter(const Subject& s) {
  Exercise e;
  e.usual = [&s](const Context& c) { return apply(s, s.world.atlas, c); };
  for (const OddPayload& odd : odd_payloads())
    e.odd.emplace_back(odd.name, [&s, odd](const Context& c) {
      return apply(
          s, with_payloads(s.world.atlas, [&odd](NodeRef, const Payload&) { return odd.payload; }),
          c);
    });
  e.odd.emplace_back("missions of one node",
                     [&s](const Context& c) { return apply(s, first_nodes(s.world.atlas, 1), c); });
  return e;
}

}  // namespace cambium::conformance
