// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/binder.hpp"

#include <gtest/gtest.h>

#include "cambium/files.hpp"
#include "pipeline/params.hpp"
#include "pipeline/yaml.hpp"
#include "support/support.hpp"

using namespace cambium;

namespace {

class Sample : public Component {
 public:
  int rings = 20;
  double range = 80;
  bool level = true;
  std::string loss = "none";
  std::vector<double> radii{1, 2};
  void params(ParamVisitor& v) override {
    v("rings", rings, "Number of radial rings", between(1, 200));
    v("range", range, "Points farther than this are ignored", above(0.0, "m"));
    v("level", level, "Turn the cloud upright first");
    v("loss", loss, "Robust loss", one_of({"none", "huber", "dcs"}));
    v("radii", radii, "Search radii", above(0.0, "m"));
  }
  std::string check_params() const override {
    return radii.size() > 3 ? "at most 3 radii are of use" : "";
  }
};

void bind_yaml(Component& component, const std::string& yaml) {
  Diagnostics diagnostics;
  bind_params(component, parse_yaml(yaml, "p.yaml", diagnostics), diagnostics);
  diagnostics.throw_if_any();
}

std::string mistakes(const std::string& yaml) {
  Sample sample;
  try {
    bind_yaml(sample, yaml);
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ErrorCode::config);
    return e.what();
  }
  return "";
}

}  // namespace

TEST(Binder, SetsEveryType) {
  Sample s;
  bind_yaml(s, "{rings: 5, range: 1e2, level: false, loss: dcs, radii: [3, 4.5]}");
  EXPECT_EQ(s.rings, 5);
  EXPECT_EQ(s.range, 100.0);
  EXPECT_FALSE(s.level);
  EXPECT_EQ(s.loss, "dcs");
  EXPECT_EQ(s.radii, (std::vector<double>{3, 4.5}));
}

TEST(Binder, KeepsDefaults) {
  Sample s;
  bind_yaml(s, "");
  EXPECT_EQ(s.rings, 20);
}

TEST(Binder, NamesAllMistakesAtOnceWithLineAndColumn) {
  const std::string text = mistakes("rigns: 3\nrange: -1\nlevel: yes\nloss: hubr\nradii: [1, x]\n");
  EXPECT_NE(text.find("p.yaml:1:1: unknown parameter 'rigns'; did you mean 'rings'?"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("p.yaml:2:8: 'range' must satisfy above 0 m, found -1"), std::string::npos)
      << text;
  EXPECT_NE(text.find("p.yaml:3:8: 'level' must be true or false, found 'yes'"), std::string::npos)
      << text;
  EXPECT_NE(text.find("'loss' cannot be 'hubr'; did you mean 'huber'?"), std::string::npos) << text;
  EXPECT_NE(text.find("p.yaml:5:12: 'radii' must be a number, found 'x'"), std::string::npos)
      << text;
}

TEST(Binder, RefusesWhatIsNearlyRight) {
  EXPECT_NE(mistakes("rings: 2.5"), "");
  EXPECT_NE(mistakes("rings: '5'"), "");
  EXPECT_NE(mistakes("rings: 201"), "");
  EXPECT_NE(mistakes("rings: 99999999999"), "");
  EXPECT_NE(mistakes("range: nan"), "");
  EXPECT_NE(mistakes("range: 1,5"), "");
  EXPECT_NE(mistakes("radii: 3"), "");
  EXPECT_NE(mistakes("radii: [1, 2, 3, 4]"), "");
  EXPECT_NE(mistakes("[1, 2]"), "");
}

TEST(Params, CanonicalFormNamesEveryValueAndReadsBack) {
  Sample a, b;
  a.range = 0.1 + 0.2;
  a.loss = "dcs";
  a.radii = {1.0 / 3.0};
  bind_yaml(b, canonical_params(a));
  EXPECT_EQ(a.range, b.range);
  EXPECT_EQ(a.radii, b.radii);
  EXPECT_EQ(canonical_params(a), canonical_params(b));
  EXPECT_NE(canonical_params(a), canonical_params(Sample{}));
}

TEST(Yaml, DuplicateKeysAreErrors) {
  Diagnostics diagnostics;
  parse_yaml("a: 1\nb: {c: 1, c: 2}\n", "p.yaml", diagnostics);
  try {
    diagnostics.throw_if_any();
    FAIL();
  } catch (const Error& e) {
    EXPECT_STREQ(e.what(), "p.yaml:2:11: duplicate key 'c', first given at p.yaml:2:5");
  }
}

namespace {

class WithFile : public Component {
 public:
  std::string model, other;
  void params(ParamVisitor& v) override {
    v("model", model, "Weights of the network", in_unit("file"));
    v("other", other, "A text that is no file");
  }
};

void bind_at(Component& c, const std::string& yaml, const std::filesystem::path& file) {
  Diagnostics diagnostics;
  bind_params(c, parse_yaml(yaml, file.string(), diagnostics), diagnostics);
  diagnostics.throw_if_any();
}

}  // namespace

TEST(BinderFiles, AreRelativeToTheFileThatNamesThem) {
  const cambium::testing::TemporaryFolder folder;
  write_file(folder / "net.onnx", "weights");
  WithFile c;
  bind_at(c, "{model: net.onnx, other: net.onnx}", folder / "p.yaml");
  EXPECT_EQ(c.model, (folder / "net.onnx").string());
  EXPECT_EQ(c.other, "net.onnx");
  bind_at(c, "model: ''", folder / "p.yaml");
  EXPECT_EQ(c.model, "");
}

TEST(BinderFiles, MustBeThere) {
  const cambium::testing::TemporaryFolder folder;
  WithFile c;
  try {
    bind_at(c, "{model: nett.onnx}", folder / "p.yaml");
    FAIL();
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("there is no file '" + (folder / "nett.onnx").string()),
              std::string::npos)
        << e.what();
  }
}

TEST(BinderFiles, CountByTheirContentForTheKey) {
  const cambium::testing::TemporaryFolder folder;
  const auto key = [&](const std::string& name, const std::string& content) {
    write_file(folder / name, content);
    WithFile c;
    bind_at(c, "model: " + name, folder / "p.yaml");
    return identifying_params(c);
  };
  EXPECT_EQ(key("a", "weights"), key("b", "weights"));
  EXPECT_NE(key("a", "weights"), key("a", "other weights"));
  EXPECT_EQ(identifying_params(*std::make_unique<WithFile>()),
            canonical_params(*std::make_unique<WithFile>()));
}
