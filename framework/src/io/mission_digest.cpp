// SPDX-License-Identifier: BSD-3-Clause
#include <cstring>

#include "cambium/dialect.hpp"

namespace cambium {
namespace {

/// A digest over many small values, in memory of fixed size.
class Chain {
 public:
  template <class Number>
  void number(Number value) {
    static_assert(sizeof value == 8);
    char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    block_.append(bytes, sizeof value);
    if (block_.size() >= block_bytes) close_block();
  }
  void text(std::string_view text) {
    number(std::uint64_t(text.size()));
    block_ += text;
  }
  void pose(const SE3& T) {
    for (int i = 0; i < 4; ++i) number(T.q.coeffs()[i]);
    for (int i = 0; i < 3; ++i) number(T.t[i]);
  }
  template <class Matrix>
  void matrix(const Matrix& m) {
    block_.append(reinterpret_cast<const char*>(m.data()), sizeof(double) * std::size_t(m.size()));
    if (block_.size() >= block_bytes) close_block();
  }
  void stamp(const Stamp& stamp) {
    number(stamp.sec);
    number(std::int64_t(stamp.nsec));
  }
  Digest digest() {
    close_block();
    return chained_;
  }

 private:
  void close_block() {
    chained_ = Hasher().add(chained_).add(block_).digest();
    block_.clear();
  }
  static constexpr std::size_t block_bytes = 1 << 16;
  std::string block_;
  Digest chained_;
};

void add_georeference(Chain& chain, const std::optional<GeoReference>& georeference) {
  chain.number(std::uint64_t(georeference.has_value()));
  if (!georeference) return;
  const GeoReference& g = *georeference;
  for (const double v : {g.latitude, g.longitude, g.altitude, g.sigma_yaw, g.sigma_position})
    chain.number(v);
  chain.pose(g.T_map_enu);
}

void add_node(Chain& chain, const Node& node) {
  chain.number(node.id);
  chain.number(std::uint64_t(node.fixed) + 2 * std::uint64_t(node.stamp.has_value()));
  if (node.stamp) chain.stamp(*node.stamp);
  chain.pose(node.T_mission_node);
}

void add_edge(Chain& chain, const Edge& edge) {
  chain.number(std::int64_t(edge.kind));
  chain.number(edge.tail);
  chain.number(edge.head);
  chain.pose(edge.T_tail_head);
  chain.matrix(edge.information);
  chain.text(edge.tag);
  chain.text(edge.extra);
}

void add_fix(Chain& chain, const GnssFix& fix) {
  chain.stamp(fix.stamp);
  for (const double v : {fix.latitude, fix.longitude, fix.altitude}) chain.number(v);
  chain.matrix(fix.covariance);
}

}  // namespace

Digest mission_digest(const Mission& mission) {
  Chain chain;
  chain.text(mission.name);
  chain.number(std::int64_t(mission.platform_id));
  add_georeference(chain, mission.georeference);
  chain.number(std::uint64_t(mission.nodes.size()));
  for (const Node& node : mission.nodes) add_node(chain, node);
  chain.number(std::uint64_t(mission.edges.size()));
  for (const Edge& edge : mission.edges) add_edge(chain, edge);
  chain.number(std::uint64_t(mission.fixes.size()));
  for (const GnssFix& fix : mission.fixes) add_fix(chain, fix);
  for (const RawLine& raw : mission.unknown_lines) chain.text(raw.text);
  return chain.digest();
}

}  // namespace cambium
