// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "cambium/path.hpp"
#include "conformance/law.hpp"

namespace cambium::conformance {
namespace {

void check(const std::vector<Candidate>& candidates, std::size_t queries, std::size_t references,
           const Pairing& pairing) {
  for (const Candidate& c : candidates) {
    const std::string pair = fmt::format("candidate ({}, {})", c.query, c.reference);
    require(c.query < queries && c.reference < references,
            fmt::format("{} of missions with {} and {} nodes", pair, queries, references));
    require(std::isfinite(c.score), pair + " has a score that is not finite");
    require(!c.T_reference_query || c.T_reference_query->finite(),
            pair + " has a guess that is not finite");
    require(pairing.allowed(c.query, c.reference),
            pair + " lies too near along the path; respect pairing.allowed()");
  }
}

Pairing pairing_of(const Mission& query, const Mission& reference, bool within) {
  return {within, 15.0, travelled(query), travelled(reference)};
}

std::vector<Candidate> recognize(const Subject& s, const Atlas& atlas, std::uint32_t query,
                                 std::uint32_t reference, const Context& context) {
  const auto& recognizer = s.as<PlaceRecognizer>();
  const Fingerprints a = recognizer.describe({atlas, query}, context);
  const Fingerprints b =
      query == reference ? Fingerprints{} : recognizer.describe({atlas, reference}, context);
  const Mission &q = *atlas.missions[query].mission, &r = *atlas.missions[reference].mission;
  const Pairing pairing = pairing_of(q, r, query == reference);
  auto out = recognizer.match(a, query == reference ? a : b, pairing, context);
  check(out, q.nodes.size(), r.nodes.size(), pairing);
  return out;
}

std::string bytes_of(const Subject& s, const Atlas& atlas, const Context& context) {
  std::string out = encode(s.as<PlaceRecognizer>().describe({atlas, 0}, context));
  out += encode(recognize(s, atlas, 1, 0, context));
  return out + encode(recognize(s, atlas, 0, 0, context));
}

/// The best reference of every query.
std::map<std::size_t, std::size_t> first_ranks(const std::vector<Candidate>& candidates) {
  std::map<std::size_t, const Candidate*> best;
  for (const Candidate& c : candidates) {
    const auto [it, fresh] = best.emplace(c.query, &c);
    if (!fresh && c.score > it->second->score) it->second = &c;
  }
  std::map<std::size_t, std::size_t> out;
  for (const auto& [query, c] : best) out[query] = c->reference;
  return out;
}

// Mission 1 becomes a copy of mission 0, every node turned by its own angle about the vertical.
Atlas copied(const World& world, double turn) {
  Atlas atlas = world.atlas;
  const std::string name = atlas.missions[1].mission->name;
  Mission copy = *atlas.missions[0].mission;
  auto poses = *atlas.missions[0].T_map_node;
  copy.name = name;
  copy.digest = Hasher().add("copy").add(turn).digest();
  const auto turned = [turn](std::size_t i) {
    return SE3::from_yaw(turn * double(i + 1), {0, 0, 0});
  };
  for (std::size_t i = 0; i < copy.nodes.size(); ++i) {
    copy.nodes[i].T_mission_node = copy.nodes[i].T_mission_node * turned(i);
    poses[i] = poses[i] * turned(i);
  }
  atlas.missions[1].mission = std::make_shared<const Mission>(std::move(copy));
  atlas.missions[1].T_map_node = std::make_shared<const std::vector<SE3>>(std::move(poses));
  atlas.payloads = std::make_shared<const PayloadSources>(
      PayloadSources{(*world.atlas.payloads)[0], (*world.atlas.payloads)[0]});
  return with_payloads(atlas, [&](NodeRef n, const Payload&) {
    Payload p = world.atlas.payload({0, n.node});
    if (n.mission == 0 || turn == 0) return p;
    const SE3 T_turned_node = turned(n.node).inverse();
    p.cloud = std::make_shared<const Cloud>(transformed(T_turned_node, *p.cloud));
    std::vector<Tree> trees = *p.trees;
    for (Tree& t : trees) t.base = T_turned_node * t.base, t.axis = T_turned_node.q * t.axis;
    p.trees = std::make_shared<const std::vector<Tree>>(std::move(trees));
    return p;
  });
}

double share_at_rank_one(const Subject& s, double turn) {
  const Host host(2);
  const auto found = first_ranks(recognize(s, copied(s.world, turn), 1, 0, *host.context()));
  if (found.empty())
    throw NotApplicable("proposes nothing on the kit's forest with its default parameters");
  const auto right =
      std::count_if(found.begin(), found.end(), [](const auto& f) { return f.first == f.second; });
  return double(right) / double(found.size());
}

void finds_a_copy(const Subject& s) {
  const double share = share_at_rank_one(s, 0);
  require(share >= 0.9,
          fmt::format("of a mission and its copy, {:.0f} % of the best candidates are "
                      "the copied node; expected 90 %",
                      100 * share));
}

void keeps_yaw_promise(const Subject& s) {
  if (!s.as<PlaceRecognizer>().yaw_invariant()) throw NotApplicable("declares no yaw invariance");
  const double share = share_at_rank_one(s, 2.399963);  // the golden angle [rad]
  require(share >= 0.9, fmt::format("yaw_invariant() is true, but of a mission and its turned copy "
                                    "{:.0f} % of the best candidates are the copied node; expected "
                                    "90 %",
                                    100 * share));
}

}  // namespace

Exercise exercise_recognizer(const Subject& s) {
  Exercise e;
  e.usual = [&s](const Context& c) { return bytes_of(s, s.world.atlas, c); };
  for (const OddPayload& odd : odd_payloads()) {
    const auto every = [odd](NodeRef, const Payload&) { return odd.payload; };
    const auto some = [odd](NodeRef n, const Payload& p) { return n.node % 3 ? p : odd.payload; };
    e.odd.emplace_back("missions of " + odd.name, [&s, every](const Context& c) {
      return bytes_of(s, with_payloads(s.world.atlas, every), c);
    });
    e.odd.emplace_back("missions with " + odd.name + " here and there",
                       [&s, some](const Context& c) {
                         return bytes_of(s, with_payloads(s.world.atlas, some), c);
                       });
  }
  e.odd.emplace_back("missions of one node", [&s](const Context& c) {
    return bytes_of(s, first_nodes(s.world.atlas, 1), c);
  });
  e.own = {{"finds a copied place at rank 1", finds_a_copy},
           {"keeps its promise of yaw invariance", keeps_yaw_promise}};
  return e;
}

}  // namespace cambium::conformance
