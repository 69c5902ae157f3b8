// SPDX-License-Identifier: BSD-3-Clause
// Components that break one law each; integration/conformance_test.cpp expects the kit to say
// which.
#include <chrono>
#include <cstdio>
#include <thread>

#include "cambium/plugin.hpp"

using namespace cambium;

namespace {

/// A filter that does nothing wrong.
class Lawful : public PayloadFilter {
 public:
  void params(ParamVisitor& v) override {
    v("level", level_, "A number that nothing depends on", between(0, 10));
  }
  Payload apply(const MissionView& mission, std::size_t node, const Context&) const override {
    return mission.payload(node);
  }

 protected:
  int level_ = 1;
};

class Undocumented final : public Lawful {
  void params(ParamVisitor& v) override { v("level", level_, "?", between(0, 10)); }
};

class OutOfBounds final : public Lawful {
  void params(ParamVisitor& v) override {
    v("level", level_, "A number above its own default", between(5, 10));
  }
};

class Crashes final : public Lawful {
  Payload apply(const MissionView& mission, std::size_t node, const Context&) const override {
    Payload p = mission.payload(node);
    if (!p.cloud) *const_cast<volatile int*>(static_cast<int*>(nullptr)) = 1;
    return p;
  }
};

class Prints final : public Lawful {
  Payload apply(const MissionView& mission, std::size_t node, const Context&) const override {
    std::puts("filtering");
    return mission.payload(node);
  }
};

class Stubborn final : public Lawful {
  Payload apply(const MissionView& mission, std::size_t node, const Context&) const override {
    std::this_thread::sleep_for(std::chrono::milliseconds(300));  // six nodes: 1.8 s
    return mission.payload(node);
  }
};

class CountsCalls final : public Lawful {
  Payload apply(const MissionView& mission, std::size_t node, const Context&) const override {
    Payload p = mission.payload(node);
    if (!p.cloud) return p;
    Cloud cloud = *p.cloud;
    for (float& x : cloud.xyz) x += float(calls_);
    ++calls_;
    p.cloud = std::make_shared<const Cloud>(std::move(cloud));
    return p;
  }
  mutable int calls_ = 0;
};

class ThrowsOther final : public Lawful {
  Payload apply(const MissionView& mission, std::size_t node, const Context&) const override {
    Payload p = mission.payload(node);
    if (p.cloud && p.cloud->empty()) throw std::out_of_range("vector");
    return p;
  }
};

class RaisesCost final : public Solver {
  Solution solve(const PoseGraph& graph, const Context&) const override {
    Solution out;
    out.T_map_node = graph.T_map_node;
    for (std::size_t i = 1; i < out.T_map_node.size(); ++i) out.T_map_node[i].t.x() += double(i);
    return out;
  }
};

class BelievesAll final : public LoopVerifier {
  std::vector<Verdict> verify(const Atlas&, std::span<const std::size_t> loops,
                              const Context&) const override {
    return std::vector<Verdict>(loops.size(), {true, "why not"});
  }
};

/// Compares clouds by how far they reach to the front, which a turn changes.
class LooksAhead final : public PlaceRecognizer {
  bool yaw_invariant() const override { return true; }
  Fingerprints describe(const MissionView& mission, const Context&) const override {
    Fingerprints out{mission.size(), 1, std::vector<float>(mission.size()), {}};
    for (std::size_t i = 0; i < mission.size(); ++i) {
      const Payload p = mission.payload(i);
      for (std::size_t k = 0; p.cloud && k < p.cloud->size(); ++k)
        if (p.cloud->xyz[3 * k] > 0 && p.cloud->xyz[3 * k] < 100)
          out.table[i] += p.cloud->xyz[3 * k];
    }
    return out;
  }
  std::vector<Candidate> match(const Fingerprints& query, const Fingerprints& reference,
                               const Pairing& pairing, const Context&) const override {
    std::vector<Candidate> out;
    for (std::size_t q = 0; q < query.rows; ++q)
      for (std::size_t r = 0; r < reference.rows; ++r)
        if (pairing.allowed(q, r))
          out.push_back({q, r, -std::abs(double(query.table[q]) - reference.table[r]), {}});
    return out;
  }
};

}  // namespace

CAMBIUM_PLUGIN("lawless", "1.0.0") {
  registry.add<Lawful>("lawful", "Breaks no law");
  registry.add<Undocumented>("undocumented", "A parameter without a line for the user");
  registry.add<OutOfBounds>("out_of_bounds", "A default outside of its bounds");
  registry.add<Crashes>("crashes", "Crashes without a cloud");
  registry.add<Prints>("prints", "Prints to stdout");
  registry.add<Stubborn>("stubborn", "Does not look whether it is cancelled");
  registry.add<CountsCalls>("counts_calls", "Has hidden state");
  registry.add<ThrowsOther>("throws_other", "Throws what is no Error");
  registry.add<RaisesCost>("raises_cost", "Makes the graph worse");
  registry.add<BelievesAll>("believes_all", "Accepts every loop");
  registry.add<LooksAhead>("looks_ahead", "Promises yaw invariance and does not keep it");
}
