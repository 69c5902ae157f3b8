// SPDX-License-Identifier: BSD-3-Clause
#include "matrix/compare.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "host.hpp"

namespace cambium::cli {
namespace {

struct Options {
  std::filesystem::path before, after;
  double alpha = 0.05;
  bool check = false;
};

void print(const matrix::Comparison& c) {
  fmt::print("{:<44} {:<28} {:>11} {:>11} {:>8} {:>7}  {}\n", "cell", "metric", "before", "after",
             "change", "p", "verdict");
  for (const matrix::Change& m : c.changes) {
    const double change = (m.after - m.before) / std::abs(m.before);
    fmt::print("{:<44} {:<28} {:>11.5g} {:>11.5g} {:>8} {:>7.3f}  {}\n", m.cell, m.metric.name,
               m.before, m.after,
               std::isfinite(change) ? fmt::format("{:+.1f}%", 100 * change) : "-", m.p,
               to_string(m.verdict));
  }
  for (const auto& cell : c.only_before) fmt::print("{:<44} only before\n", cell);
  for (const auto& cell : c.only_after) fmt::print("{:<44} only after\n", cell);
  fmt::print("{} metrics moved, {} are the same\n", c.changes.size(), c.same);
}

void run(const Options& o) {
  const auto c =
      matrix::compare(matrix::read_results(o.before), matrix::read_results(o.after), o.alpha);
  print(c);
  const auto worse = std::count_if(c.changes.begin(), c.changes.end(), [](const auto& m) {
    return m.verdict == matrix::Change::Verdict::worse;
  });
  if (o.check && worse > 0)
    throw Error(ErrorCode::check, o.after.string(), fmt::format("{} metrics got worse", worse));
}

}  // namespace

void add_compare(CLI::App& app) {
  auto o = std::make_shared<Options>();
  CLI::App* sub =
      app.add_subcommand("compare", "Say what moved between two results of a matrix, beyond noise");
  sub->add_option("BEFORE", o->before, "results.json, or the folder that holds it")->required();
  sub->add_option("AFTER", o->after, "The same of the later one")->required();
  sub->add_option("--alpha", o->alpha, "A metric moved when p (Mann-Whitney) is below this")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  sub->add_flag("--check", o->check, "Exit code 1 when a metric got worse");
  sub->footer(
      "Noise is told from the runs of each cell: 'repeat: 4' or more in the matrix.\n"
      "Example: cambium compare out/before out/after");
  sub->callback([o] { run(*o); });
}

}  // namespace cambium::cli
