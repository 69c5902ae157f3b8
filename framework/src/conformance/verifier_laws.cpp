// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "conformance/law.hpp"

namespace cambium::conformance {
namespace {

std::vector<Verdict> verify(const Subject& s, const Atlas& atlas,
                            const std::vector<std::size_t>& loops, const Context& context) {
  auto verdicts = s.as<LoopVerifier>().verify(atlas, loops, context);
  require(verdicts.size() == loops.size(),
          fmt::format("{} verdicts for {} loops; expected one for each, in their order",
                      verdicts.size(), loops.size()));
  for (std::size_t i = 0; i < verdicts.size(); ++i)
    require(verdicts[i].accepted || !verdicts[i].reason.empty(),
            fmt::format("loop {} is rejected without a reason", loops[i]));
  return verdicts;
}

/// The true loops, registered but not judged, and three wrong ones among them.
Atlas with_wrong_loops(const World& world) {
  Atlas atlas = world.atlas;
  for (std::size_t i = 0; i < atlas.loops.size(); ++i) {
    Loop& loop = atlas.loops[i];
    loop.state = LoopState::registered;
    if (i % 9 == 4) loop.T_tail_head.t += Vec3(3.0 + double(i), -4, 0.5);
  }
  return atlas;
}

std::vector<std::size_t> all(const Atlas& atlas) {
  std::vector<std::size_t> loops(atlas.loops.size());
  std::iota(loops.begin(), loops.end(), 0);
  return loops;
}

void any_order(const Subject& s) {
  const Host host(1);
  const Atlas atlas = with_wrong_loops(s.world);
  std::vector<std::size_t> forwards = all(atlas), backwards = forwards;
  std::reverse(backwards.begin(), backwards.end());
  const auto a = verify(s, atlas, forwards, *host.context());
  auto b = verify(s, atlas, backwards, *host.context());
  std::reverse(b.begin(), b.end());
  for (std::size_t i = 0; i < a.size(); ++i)
    require(a[i].accepted == b[i].accepted,
            fmt::format("loop {} is judged otherwise when the loops come in reverse order", i));
}

void tells_right_from_wrong(const Subject& s) {
  const Host host(1);
  const Atlas atlas = with_wrong_loops(s.world);
  const auto verdicts = verify(s, atlas, all(atlas), *host.context());
  std::size_t wrong_accepted = 0;
  for (std::size_t i = 0; i < verdicts.size(); ++i)
    wrong_accepted += i % 9 == 4 && verdicts[i].accepted;
  require(wrong_accepted == 0,
          fmt::format("accepted {} loops that are metres off among {} right ones", wrong_accepted,
                      verdicts.size()));
}

}  // namespace

Exercise exercise_verifier(const Subject& s) {
  const Atlas atlas = with_wrong_loops(s.world);
  Exercise e;
  e.usual = [&s, atlas](const Context& c) { return encode(verify(s, atlas, all(atlas), c)); };
  e.odd = {{"no loops", [&s, atlas](const Context& c) { return encode(verify(s, atlas, {}, c)); }},
           {"one loop", [&s, atlas](const Context& c) { return encode(verify(s, atlas, {0}, c)); }},
           {"a loop with zero information", [&s, atlas](const Context& c) {
              Atlas weak = atlas;
              weak.loops[0].information.setZero();
              return encode(verify(s, weak, all(weak), c));
            }}};
  e.own = {{"judges loops in any order alike", any_order},
           {"accepts no loop that is metres off", tells_right_from_wrong}};
  return e;
}

}  // namespace cambium::conformance
