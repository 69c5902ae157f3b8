// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "cambium/error.hpp"
#include "cambium/files.hpp"
#include "simulate/spec_file.hpp"
#include "support/places.hpp"

namespace cambium::simulate {
namespace {

std::string mistake(const std::string& text) {
  try {
    parse_spec(text, "spec.yaml");
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ErrorCode::config);
    return e.what();
  }
  return "";
}

TEST(Spec, TopLevelSectionsHoldForAllMissions) {
  const auto s = parse_spec(
      "version: 1\nseed: 5\nsensor: {beams: 16, columns: 512}\nmissions:\n"
      "  - name: a\n  - name: b\n    sensor: {beams: 64}\n    start: 1800000000\n  - {name: c}\n",
      "spec.yaml");
  EXPECT_EQ(s.seed, 5);
  ASSERT_EQ(s.missions.size(), 3u);
  EXPECT_EQ(s.missions[0].sensor.beams, 16);
  EXPECT_EQ(s.missions[1].sensor.beams, 64);
  EXPECT_EQ(s.missions[1].sensor.columns, 512);
  EXPECT_EQ(s.missions[2].sensor.beams, 16);
  EXPECT_EQ(s.missions[2].start, 1800003600);  // an hour after b
}

TEST(Spec, EveryMistakeIsReportedWithItsPlace) {
  const std::string all = mistake(
      "version: 1\nstand: {densty: 900, hard_core: 9}\nterain: {}\nmissions:\n"
      "  - name: a\n    path: {kind: circle}\n  - name: a\n  - platform: 1.5\n");
  for (const char* part :
       {"spec.yaml:2:9", "did you mean 'density'", "'hard_core' must satisfy", "spec.yaml:3:1",
        "did you mean 'terrain'", "'kind' cannot be 'circle'", "a second mission is named 'a'",
        "'platform' must be a whole number", "a mission needs a 'name'"})
    EXPECT_NE(all.find(part), std::string::npos) << part << " is not in\n" << all;
}

TEST(Spec, RefusesWhatIsNoSpecification) {
  EXPECT_NE(mistake("").find("map"), std::string::npos);
  EXPECT_NE(mistake("version: 1\n").find("'missions'"), std::string::npos);
  EXPECT_NE(mistake("missions: [{name: a}]\n").find("version: 1"), std::string::npos);
  EXPECT_NE(mistake("version: 1\nmissions: []\n").find("one mission or more"), std::string::npos);
  EXPECT_NE(mistake("version: 1\nmissions: [{name: ../a}]\n").find("folder"), std::string::npos);
}

TEST(Spec, CommittedSchemaIsThatOfTheCode) {
  const auto path = testing::source("schemas/simulate.schema.json");
  EXPECT_EQ(read_file(path), spec_schema().dump(2) + "\n")
      << "run: ./bootstrap generate";
}

// Every key with its default and its meaning stands in a table of the documentation.
void expect_rows(const nlohmann::ordered_json& properties, const std::string& page) {
  for (const auto& [key, schema] : properties.items()) {
    if (schema.contains("properties")) expect_rows(schema["properties"], page);
    if (!schema.contains("default")) continue;
    const std::string row = "| `" + key + "` | " + schema["default"].dump() + " | " +
                            schema["description"].get<std::string>() + " |\n";
    EXPECT_NE(page.find(row), std::string::npos) << "docs/simulate.md lacks\n" << row;
  }
}

TEST(Spec, DocumentationNamesEveryKey) {
  const std::string page = read_file(testing::source("docs/simulate.md"));
  const auto schema = spec_schema()["properties"];
  expect_rows(schema, page);
  expect_rows(schema["missions"]["items"]["properties"], page);
}

}  // namespace
}  // namespace cambium::simulate
