// SPDX-License-Identifier: BSD-3-Clause
// What scripts get, return, and do wrong. That each kind works at all is for the conformance kit.
#include "cambium/files.hpp"
#include "support/plain_context.hpp"
#include "support/support.hpp"

namespace cambium::testing {
namespace {

const std::string imports =
    "import numpy as np\nfrom cambium import *\nfrom cambium import Error\n";

/// A script in a folder of its own.
class PythonScript : public ::testing::Test {
 protected:
  std::string write(const std::string& body, const std::string& name = "my.py") {
    write_file(folder_ / name, imports + body);
    return (folder_ / name).string();
  }
  template <class T>
  std::shared_ptr<const T> load(const std::string& body, const std::string& more = "") {
    return component<T>("python", "{script: " + write(body) + more + "}");
  }
  template <class F>
  static Error error_of(F&& f) {
    try {
      f();
    } catch (const Error& e) {
      return e;
    }
    ADD_FAILURE() << "expected an Error";
    return Error(ErrorCode::check, "", "");
  }
  static void expect(const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  }
  TemporaryFolder folder_;
};

Atlas one_cloud(std::size_t nodes = 1) {
  Mission mission = make_mission("a", std::vector<SE3>(nodes));
  for (auto& node : mission.nodes) node.payload = in_memory(Cloud{{1, 2, 3, 4, 5, 6}, {}, {7, 8}});
  return make_atlas({mission});
}

Payload apply(const PayloadFilter& filter, const Atlas& atlas, std::size_t node = 0) {
  return filter.apply({atlas, 0}, node, *make_context());
}

TEST_F(PythonScript, SeesTheHostsOwnMemoryAndCannotWriteToIt) {
  const auto recognizer = load<PlaceRecognizer>(R"(
class Where(PlaceRecognizer):
    def describe(self, mission, context):
        cloud = mission.payload(0).cloud
        assert cloud.points.shape == (2, 3) and cloud.points.dtype == np.float32
        assert cloud.normals is None and list(cloud.intensity) == [7, 8]
        for change in (lambda p: p.__setitem__((0, 0), 1), lambda p: p.setflags(write=True)):
            try:
                change(cloud.points)
                raise AssertionError("could be changed")
            except ValueError:
                pass
        return np.zeros((1, 0)), str(cloud.points.__array_interface__["data"][0]).encode()
    def match(self, query, reference, pairing, context):
        return []
)");
  const Atlas atlas = one_cloud();
  const Payload payload = atlas.payload({0, 0});
  const Fingerprints f = recognizer->describe({atlas, 0}, *make_context());
  const std::string address(reinterpret_cast<const char*>(f.extra.data()), f.extra.size());
  EXPECT_EQ(address, std::to_string(std::uintptr_t(payload.cloud->xyz.data())));
}

TEST_F(PythonScript, ParametersAreThoseOfTheClass) {
  const std::string body = R"(
class Base(PayloadFilter):
    scale = Param(2.0, "Factor of all coordinates", above(0, "m"))
class Mine(Base):
    times = Param(1, "How often", between(1, 3))
    how = Param("up", "Which way", one_of(["up", "down"]))
    limits = Param([1, 2], "Two numbers", in_unit("m"))
    def check_params(self):
        return "" if len(self.limits) == 2 else "limits: expected two numbers"
    def apply(self, mission, node, context):
        assert self.limits == [1.0, 2.0] and self.how == "down"
        return Payload(Cloud(mission.payload(node).cloud.points * self.scale**self.times))
)";
  const auto filter = load<PayloadFilter>(body, ", class: Mine, scale: 3, times: 2, how: down");
  EXPECT_EQ(apply(*filter, one_cloud()).cloud->xyz, (std::vector<float>{9, 18, 27, 36, 45, 54}));
  const auto wrong = [&](const std::string& more) {
    return std::string(
        error_of([&] { load<PayloadFilter>(body, ", class: Mine, " + more); }).what());
  };
  expect(wrong("tims: 2"), "unknown parameter 'tims'; did you mean 'times'?");
  expect(wrong("times: 4"), "'times' must satisfy 1 <= value <= 3, found 4");
  expect(wrong("scale: 0"), "above 0 m");
  expect(wrong("how: left"), "'how' cannot be 'left'");
  expect(wrong("limits: [1]"), "limits: expected two numbers");
  expect(error_of([] { component<PayloadFilter>("python", "{script: nowhere.py}"); }).what(),
         "there is no file");
}

TEST_F(PythonScript, AnExceptionNamesTheLineAndShowsTheTraceback) {
  const auto filter = load<PayloadFilter>(R"(
class Mine(PayloadFilter):
    def apply(self, mission, node, context):
        return self.helper(mission.payload(node))
    def helper(self, payload):
        return payload.nothing
)");
  const Error e = error_of([&] { apply(*filter, one_cloud()); });
  EXPECT_EQ(e.code(), ErrorCode::plugin);
  expect(e.where(), "my.py:9");
  expect(e.message(), "AttributeError: ");
  expect(e.message(), "line 7, in apply");
  expect(e.message(), "return payload.nothing");
}

TEST_F(PythonScript, AMistakeInTheFileNamesTheLine) {
  const Error e = error_of([&] { load<PayloadFilter>("x = (1,\n\nclass A:\n"); });
  expect(e.where(), "my.py:4");
  expect(e.message(), "SyntaxError");
  expect(error_of([&] { load<PayloadFilter>("import no_such_module_\n"); }).message(),
         "No module named 'no_such_module_'");
}

TEST_F(PythonScript, TheClassMustBeThereOnceAndWhole) {
  const std::string two =
      "class A(PayloadFilter):\n  def apply(self, *_): pass\nclass B(A): pass\n";
  const auto message = [&](const std::string& body, const std::string& more = "") {
    return error_of([&] { load<PayloadFilter>(body, more); }).message();
  };
  expect(message(two), "found A(PayloadFilter), B(A); name one of them with the parameter 'class'");
  EXPECT_TRUE(load<PayloadFilter>(two, ", class: B"));
  expect(message("class A(Evaluator): pass\n"), "expected one class of PayloadFilter, found A");
  expect(message("class A(PayloadFilter): pass\n"), "lacks the method apply()");
  expect(message("class A(PayloadFilter):\n  script = Param(1, 'x')\n  apply = print\n"),
         "'script'");
  const std::string none = error_of([] { component<PayloadFilter>("python", "{}"); }).what();
  expect(none, "'script' is missing");
}

TEST_F(PythonScript, RaisesErrorsAndCancelsAsPluginsDo) {
  const auto filter = load<PayloadFilter>(R"(
class Mine(PayloadFilter):
    def apply(self, mission, node, context):
        if node == 0:
            raise Error("expected more, found less", "cloud.pcd:3")
        try:
            while True:
                context.check_cancelled()
        except Exception:
            pass
)");
  const Error e = error_of([&] { apply(*filter, one_cloud()); });
  EXPECT_EQ(e.code(), ErrorCode::data);
  EXPECT_STREQ(e.what(), "cloud.pcd:3: expected more, found less");

  class Stopped final : public PlainContext {
   public:
    bool cancelled() const override { return true; }
  };
  const Atlas atlas = one_cloud(2);
  EXPECT_THROW(filter->apply({atlas, 0}, 1, Stopped()), Cancelled);
}

TEST_F(PythonScript, WhatItReturnsIsChecked) {
  const auto message = [&](const std::string& returned) {
    const auto r = load<PlaceRecognizer>(
        "class A(PlaceRecognizer):\n"
        "  def describe(self, mission, context): return " +
        returned + "\n  def match(self, *_): return [(0, 1)]\n");
    const Atlas atlas = one_cloud();
    return error_of([&] { r->describe({atlas, 0}, *make_context()); }).message();
  };
  expect(message("np.zeros(3)"), "expected an array of shape (1, n), found one of (3)");
  expect(message("np.zeros((2, 3))"), "found one of (2, 3)");
  expect(message("'text'"), "expected an array");
  expect(message("(np.zeros((1, 3)), 4)"), "expected bytes, found a int");
}

TEST_F(PythonScript, WhatACallLendsIsNotThereAfterwards) {
  const auto filter = load<PayloadFilter>(R"(
kept = []
class Mine(PayloadFilter):
    def apply(self, mission, node, context):
        kept.append((mission, mission.payload(node).cloud.points))
        assert kept[0][1][1, 2] == 6, "arrays stay"
        return kept[0][0].payload(node)
)");
  const Atlas atlas = one_cloud();
  EXPECT_EQ(apply(*filter, atlas).cloud->size(), 2U);
  expect(error_of([&] { apply(*filter, atlas); }).message(), "only there during the call");
}

TEST_F(PythonScript, PrintIsAMessage) {
  class Listening final : public PlainContext {
   public:
    void log(LogLevel, std::string_view message) const override {
      heard.push_back(std::string(message));
    }
    mutable std::vector<std::string> heard;
  };
  const auto filter = load<PayloadFilter>(R"(
print("at import")
class Mine(PayloadFilter):
    def apply(self, mission, node, context):
        print("node", node, end="")
        print("\nand more")
        context.warn("a warning")
        return mission.payload(node)
)");
  const Listening context;
  const Atlas atlas = one_cloud();
  filter->apply({atlas, 0}, 0, context);
  EXPECT_EQ(context.heard,
            (std::vector<std::string>{"at import", "node 0", "and more", "a warning"}));
}

TEST_F(PythonScript, ScriptsBehindScriptsOnManyThreads) {
  const auto filter = load<PayloadFilter>(R"(
class Mine(PayloadFilter):
    def apply(self, mission, node, context):
        return Payload(Cloud(mission.payload(node).cloud.points + node))
)");
  class Filtered final : public PayloadSource {
   public:
    Filtered(std::shared_ptr<const PayloadFilter> f, const Atlas& a, std::size_t n)
        : filter(std::move(f)), atlas(a), node(n) {}
    Payload load() const override { return apply(*filter, atlas, node); }
    Digest digest() const override { return {}; }
    std::string where() const override { return "test"; }
    std::shared_ptr<const PayloadFilter> filter;
    const Atlas& atlas;
    std::size_t node;
  };
  const Atlas before = one_cloud(40);
  Mission mission = *before.missions[0].mission;
  for (std::size_t i = 0; i < 40; ++i)
    mission.nodes[i].payload = std::make_shared<const Filtered>(filter, before, i);
  const Atlas after = make_atlas({mission});
  write_file(folder_ / "sum.py", imports + R"(
class Sum(PlaceRecognizer):
    def describe(self, mission, context):
        out = np.zeros((len(mission), 1), np.float32)
        def one(i):
            out[i] = mission.payload(i).cloud.points.sum()
        context.parallel_for(len(mission), one)
        return out
    def match(self, *_): return []
)");
  const auto sum =
      component<PlaceRecognizer>("python", "{script: " + (folder_ / "sum.py").string() + "}");
  const Fingerprints f = sum->describe({after, 0}, *make_context(4));
  for (std::size_t i = 0; i < 40; ++i) EXPECT_EQ(f.table[i], 21.0F + 6.0F * float(i));
}

TEST_F(PythonScript, ReadsMissionsWithPayloadsThatLoadLate) {
  const auto reader = load<MissionReader>(R"(
class Mine(MissionReader):
    def accepts(self, path):
        return path.endswith(".mine")
    def read(self, path, context):
        T = np.tile(np.eye(4), (3, 1, 1))
        T[:, 0, 3] = [0, 1, 2]
        late = Source(lambda: Payload(Cloud(np.ones((4, 3)))), "ones", path)
        return Mission("m", T, stamps=[(5, 1), (6, 2), (7, 3)], ids=[4, 5, 9], payloads=[late, None,
                       Payload()], fixes=[Fix(5, 1, 60.0, 25.0, 100.0)], platform_id=3)
)");
  EXPECT_TRUE(reader->accepts("a.mine"));
  EXPECT_FALSE(reader->accepts("a.other"));
  const Mission m = reader->read(folder_ / "a.mine", *make_context());
  ASSERT_EQ(m.nodes.size(), 3U);
  EXPECT_EQ(m.nodes[2].id, 9);
  EXPECT_EQ(m.nodes[1].stamp->nsec, 2);
  EXPECT_EQ(m.nodes[0].payload->load().cloud->size(), 4U);
  EXPECT_FALSE(m.nodes[1].payload);
  EXPECT_EQ(m.edges.size(), 2U);
  EXPECT_NEAR(m.edges[1].T_tail_head.t.x(), 1, 1e-12);
  EXPECT_EQ(m.fixes.at(0).latitude, 60.0);
  EXPECT_EQ(m.platform_id, 3);
}

}  // namespace
}  // namespace cambium::testing
