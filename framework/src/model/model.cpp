// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "cambium/atlas.hpp"
#include "cambium/context.hpp"
#include "cambium/error.hpp"
#include "cambium/kinds.hpp"

namespace cambium {

Error::~Error() = default;
Cancelled::~Cancelled() = default;
Component::~Component() = default;

void Context::check_cancelled() const {
  if (cancelled()) throw Cancelled();
}

std::optional<std::size_t> Mission::index_of(NodeId id) const {
  if (nodes.empty()) return std::nullopt;
  const auto after_first = std::uint64_t(id) - std::uint64_t(nodes.front().id);
  if (after_first < nodes.size() && nodes[after_first].id == id) return after_first;  // no gaps
  const auto it = std::lower_bound(nodes.begin(), nodes.end(), id,
                                   [](const Node& n, NodeId value) { return n.id < value; });
  if (it == nodes.end() || it->id != id) return std::nullopt;
  return std::size_t(it - nodes.begin());
}

const char* to_string(LoopState state) {
  switch (state) {
    case LoopState::candidate:
      return "candidate";
    case LoopState::registered:
      return "registered";
    case LoopState::accepted:
      return "accepted";
    case LoopState::rejected:
      return "rejected";
  }
  return "?";
}

const char* to_string(Kind kind) {
  switch (kind) {
    case Kind::mission_reader:
      return "mission_reader";
    case Kind::payload_filter:
      return "payload_filter";
    case Kind::place_recognizer:
      return "place_recognizer";
    case Kind::registration:
      return "registration";
    case Kind::loop_verifier:
      return "loop_verifier";
    case Kind::solver:
      return "solver";
    case Kind::gnss_aligner:
      return "gnss_aligner";
    case Kind::map_exporter:
      return "map_exporter";
    case Kind::evaluator:
      return "evaluator";
  }
  return "?";
}

Payload Atlas::payload(NodeRef n) const {
  const auto& source = (*payloads)[n.mission][n.node];
  return source ? source->load() : Payload{};
}

}  // namespace cambium
