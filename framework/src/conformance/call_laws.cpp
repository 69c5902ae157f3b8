// SPDX-License-Identifier: BSD-3-Clause
// Laws of every use of a component, whatever its kind.
#include <fmt/format.h>

#include <chrono>
#include <thread>

#include "conformance/law.hpp"

namespace cambium::conformance {
namespace {

// A component may refuse an input by an Error; it may not fail in any other way.
std::string outcome(const Call& call, const Context& context) try {
  return call(context);
} catch (const Cancelled&) {
  throw;
} catch (const Broken&) {
  throw;
} catch (const Error& e) {
  if (e.code() == ErrorCode::plugin)  // a script's exception, for one
    throw Broken(fmt::format("says itself that it is at fault: {}", e.what()));
  return std::string("refused: ") + e.what();
} catch (const std::exception& e) {
  throw Broken(fmt::format("threw '{}'; expected a result or a cambium::Error", e.what()));
}

void same_bytes_twice(const Call& call) {
  const Host host(1);
  const auto context = host.context();
  require(outcome(call, *context) == outcome(call, *context),
          "two calls with the same input gave different results; is there hidden state, or a "
          "random number that does not come from context.seed()?");
}

void any_thread_count(const Call& call) {
  // One after the other: hosts that live side by side share the smaller number of threads.
  const auto with = [&](int threads) { return outcome(call, *Host(threads).context()); };
  require(with(1) == with(4),
          "1 and 4 threads gave different results; write result i of parallel_for to slot i, and "
          "add up in a fixed order");
}

void two_at_once(const Call& call) {
  const Host host(1);
  const std::string expected = outcome(call, *host.context());
  std::string results[2], failures[2];
  const auto run = [&](int i) {
    try {
      results[i] = outcome(call, *host.context());
    } catch (const std::exception& e) {
      failures[i] = e.what();
    }
  };
  std::thread other(run, 1);
  run(0);
  other.join();
  for (const std::string& failure : failures)
    require(failure.empty(), "two calls at once on one instance: " + failure);
  require(results[0] == expected && results[1] == expected,
          "two calls at once on one instance gave another result than one alone; methods are const "
          "because they share the instance");
}

void cancelled_call_ends(const Call& call) {
  Host host(2);
  const auto context = host.context();
  std::chrono::steady_clock::time_point cancelled, ended;
  std::string failure;
  std::thread worker([&] {
    try {
      outcome(call, *context);
    } catch (const Cancelled&) {
    } catch (const std::exception& e) {
      failure = e.what();
    }
    ended = std::chrono::steady_clock::now();
  });
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  cancelled = std::chrono::steady_clock::now();
  host.cancel();
  worker.join();
  require(failure.empty(), "when cancelled: " + failure);
  const double seconds = std::chrono::duration<double>(ended - cancelled).count();
  require(seconds < 1, fmt::format("went on for {:.1f} s after it was cancelled; call "
                                   "context.check_cancelled() at least once a second",
                                   seconds));
}

}  // namespace

std::vector<Law> call_laws(const Exercise& exercise) {
  const Call& usual = exercise.usual;
  const auto law = [&](const char* name, void (*check)(const Call&)) {
    return Law{name, [usual, check](const Subject&) { check(usual); }};
  };
  std::vector<Law> laws = {
      {"gives a sound result", [usual](const Subject&) { usual(*Host(1).context()); }},
      law("gives the same bytes twice", same_bytes_twice),
      law("gives the same bytes with 1 and 4 threads", any_thread_count),
      law("serves two calls at once", two_at_once),
      law("ends within a second when cancelled", cancelled_call_ends)};
  for (const auto& [name, call] : exercise.odd)
    laws.push_back({"bears " + name, [call = call](const Subject&) {
                      const Host host(2);
                      outcome(call, *host.context());
                    }});
  return laws;
}

}  // namespace cambium::conformance
