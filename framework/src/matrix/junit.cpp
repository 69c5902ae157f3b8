// SPDX-License-Identifier: BSD-3-Clause
// The JUnit XML that CI systems read: a suite a dataset, a test case a cell.
#include <fmt/format.h>

#include "matrix/table.hpp"

namespace cambium::matrix {
namespace {

struct Counts {
  std::size_t tests = 0, failures = 0, errors = 0, skipped = 0;
  double seconds = 0;
};

std::string test_case(const CellResult& cell, const Results& results, Counts& counts) {
  double seconds = 0;
  for (const CellRun& run : cell.runs) seconds += run.seconds;
  std::string inside;
  for (const Finding& f : results.findings) {
    if (f.cell != cell.name || !f.bad()) continue;
    const bool failure = f.kind != Finding::Kind::failure;  // the cell ran, but not well enough
    const char* tag = failure ? "failure" : "error";
    (failure ? counts.failures : counts.errors) += inside.find(tag) == std::string::npos;
    inside +=
        fmt::format("      <{0} type=\"{1}\" message=\"{2}\">{2}</{0}>\n", tag, to_string(f.kind),
                    escaped(f.metric + (f.metric.empty() ? "" : ": ") + f.text));
  }
  if (cell.status() == Status::absent) {
    ++counts.skipped;
    inside += fmt::format("      <skipped message=\"{}\"/>\n", escaped(cell.message()));
  }
  ++counts.tests;
  counts.seconds += seconds;
  return fmt::format(
      "    <testcase classname=\"{}\" name=\"{}\" time=\"{:.3f}\">\n{}    </testcase>\n",
      escaped(cell.dataset()), escaped(cell.name), seconds, inside);
}

std::string attributes(const Counts& c) {
  return fmt::format("tests=\"{}\" failures=\"{}\" errors=\"{}\" skipped=\"{}\" time=\"{:.3f}\"",
                     c.tests, c.failures, c.errors, c.skipped, c.seconds);
}

}  // namespace

std::string junit_xml(const Results& results) {
  std::string suites;
  for (const std::string& dataset : dataset_names(results.cells)) {
    Counts counts;
    std::string cases;
    for (const CellResult& cell : results.cells)
      if (cell.dataset() == dataset) cases += test_case(cell, results, counts);
    suites += fmt::format("  <testsuite name=\"{}\" {}>\n{}  </testsuite>\n", escaped(dataset),
                          attributes(counts), cases);
  }
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"{}\">\n{}"
      "</testsuites>\n",
      escaped(results.title), suites);
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else if (static_cast<unsigned char>(c) >= 0x20 || c == '\n' || c == '\t')
      out += c;  // other control characters are not allowed in XML at all
  }
  return out;
}

}  // namespace cambium::matrix
