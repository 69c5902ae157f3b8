// SPDX-License-Identifier: BSD-3-Clause
// Findings from made-up results.
#include "matrix/judge.hpp"

#include <gtest/gtest.h>

#include "matrix/compare.hpp"

namespace cambium::matrix {
namespace {

using Kind = Finding::Kind;

CellResult cell(const std::string& name, std::vector<double> ate, double recall = 0.9) {
  CellResult c{name, {{"register", name}, {"dataset", "forest"}}, {}};
  for (const double value : ate)
    c.runs.push_back({c.runs.size() + 1,
                      Status::ok,
                      "",
                      1,
                      {{"ate.rmse", value, "m", Better::lower},
                       {"loops.recall", recall, "1", Better::higher},
                       {"time.work", 10 * value, "s", Better::lower}}});
  return c;
}

std::vector<Kind> kinds(const std::vector<Finding>& findings) {
  std::vector<Kind> out;
  for (const Finding& f : findings) out.push_back(f.kind);
  return out;
}

TEST(Judge, WorseThanTheToleranceIsARegressionInTheDirectionOfTheMetric) {
  const Baseline baseline = {{"gicp", {{"ate.rmse", 1.0}, {"loops.recall", 0.9}}}};
  Spec spec;
  EXPECT_TRUE(judge(spec, {cell("gicp", {1.04}, 0.86)}, &baseline).empty());
  EXPECT_EQ(kinds(judge(spec, {cell("gicp", {1.06})}, &baseline)), (std::vector{Kind::regression}));
  EXPECT_EQ(kinds(judge(spec, {cell("gicp", {0.9})}, &baseline)), (std::vector{Kind::improvement}));
  EXPECT_EQ(kinds(judge(spec, {cell("gicp", {1.0}, 0.8)}, &baseline)),
            (std::vector{Kind::regression}));
  spec.tolerances.emplace_back().pattern = "ate.*";
  spec.tolerances.back().absolute = 0.2;
  EXPECT_TRUE(judge(spec, {cell("gicp", {1.19})}, &baseline).empty());
}

TEST(Judge, TheMedianOfTheRunsCounts) {
  const Baseline baseline = {{"gicp", {{"ate.rmse", 1.0}}}};
  EXPECT_TRUE(judge(Spec{}, {cell("gicp", {1.0, 7.0, 0.99})}, &baseline).empty());
}

TEST(Judge, AMetricThatVanishedIsARegressionAndANewCellIsNot) {
  const Baseline baseline = {{"gicp", {{"ate.gone", 1.0}}}, {"old", {{"ate.rmse", 1.0}}}};
  const auto findings = judge(Spec{}, {cell("gicp", {1}), cell("new", {1})}, &baseline);
  ASSERT_EQ(findings.size(), 3u);
  EXPECT_EQ(findings[0].kind, Kind::regression);
  EXPECT_NE(findings[0].text.find("no longer measured"), std::string::npos);
  EXPECT_FALSE(findings[1].bad());
  EXPECT_FALSE(findings[2].bad());
}

TEST(Judge, TimesAreComparedOnlyWhenAToleranceNamesThem) {
  const Baseline baseline = {{"gicp", {{"time.work", 1.0}}}};
  Spec spec;
  EXPECT_TRUE(judge(spec, {cell("gicp", {1})}, &baseline).empty());
  EXPECT_EQ(format_baseline(spec, {cell("gicp", {1})}, {}).find("time.work"), std::string::npos);
  spec.tolerances.emplace_back().pattern = "time.work";
  EXPECT_EQ(kinds(judge(spec, {cell("gicp", {1})}, &baseline)), (std::vector{Kind::regression}));
}

TEST(Judge, ExpectationsHoldForTheCellsTheyMean) {
  Spec spec;
  spec.expect.push_back({"ate.rmse", -1e9, 0.5, {{"register", {"gicp"}}}});
  const auto findings = judge(spec, {cell("gicp", {1}), cell("ndt", {9})}, nullptr);
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].cell, "gicp");
  EXPECT_NE(findings[0].text.find("at most 0.5, found 1"), std::string::npos);
  spec.expect[0].metric = "ate.rms";
  EXPECT_NE(judge(spec, {cell("gicp", {1})}, nullptr)[0].text.find("no evaluator"),
            std::string::npos);
}

TEST(Judge, FailedCellsAreFindingsAbsentOnesAreNot) {
  CellResult crashed = cell("a", {1}), absent = cell("b", {1});
  crashed.runs[0].status = Status::crashed;
  absent.runs[0].status = Status::absent;
  EXPECT_EQ(kinds(judge(Spec{}, {crashed, absent}, nullptr)),
            (std::vector{Kind::failure, Kind::note}));
  EXPECT_TRUE(crashed.values("ate.rmse").empty());
}

TEST(Judge, UpdatingKeepsTheCellsOfAbsentDatasets) {
  CellResult absent{"b", {{"dataset", "real"}}, {{0, Status::absent, "", 0, {}}}};
  const auto text = format_baseline(Spec{}, {cell("a", {1}), absent}, {{"b", {{"ate.rmse", 3}}}});
  EXPECT_EQ(Json::parse(text)["cells"]["b"]["ate.rmse"], 3);
  EXPECT_EQ(Json::parse(text)["cells"]["a"]["ate.rmse"], 1);
}

TEST(Compare, TellsMovesFromNoise) {
  const Results before{
      "m", {cell("a", {1, 2, 3, 4}), cell("b", {1, 2, 3, 4}), cell("gone", {1})}, {}, {}};
  const Results after{"m", {cell("a", {5, 6, 7, 8}), cell("b", {1.5, 2.5, 0.5, 3.5})}, {}, {}};
  const Comparison c = compare(before, after, 0.05);
  ASSERT_EQ(c.changes.size(), 4u);  // ate and time of two cells; recall is the same
  EXPECT_EQ(c.same, 2u);
  EXPECT_EQ(c.changes[0].verdict, Change::Verdict::worse);
  EXPECT_EQ(c.changes[2].verdict, Change::Verdict::noise);
  EXPECT_EQ(c.only_before, std::vector<std::string>{"gone"});
  EXPECT_EQ(compare(after, before, 0.05).changes[0].verdict, Change::Verdict::better);
}

TEST(Compare, SingleRunsTellNothing) {
  const Results before{"m", {cell("a", {1})}, {}, {}}, after{"m", {cell("a", {2})}, {}, {}};
  EXPECT_EQ(compare(before, after, 0.05).changes[0].verdict, Change::Verdict::unknown);
}

}  // namespace
}  // namespace cambium::matrix
