// SPDX-License-Identifier: BSD-3-Clause
// A matrix as the user wrote it: one base pipeline, axes of plugins, datasets, and what must hold.
// A batch is a matrix without axes.
#pragma once
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/pipeline.hpp"

namespace cambium::matrix {

/// Missions on disk or to simulate. Its keys are declared once, for binding, messages and schema.
struct Dataset : Component {
  std::string name;
  std::vector<std::string> missions;  ///< absolute, or as they lie in the archive
  std::string archive, simulate;      ///< absolute
  bool optional = false;              ///< left out, with a line that says so, when it is absent
  void params(ParamVisitor& v) override;
  std::string check_params() const override;
};

/// One value of an axis: a plugin, with parameters on top of those of the base step when the plugin
/// is the same.
struct Choice {
  std::string name, plugin;
  Yaml params;
  std::string where;
};

/// What stands in the place of the plugin of `verb`, in all its steps or only in the n-th.
struct Axis {
  std::string name;  ///< "register" or "recognize[2]"
  const Verb* verb = nullptr;
  int only = 0;  ///< from 1; 0 = every step of the verb
  std::vector<Choice> choices;
};

/// Cells by their choices: for each axis named (or "dataset") one of the values.
using Selection = std::vector<std::pair<std::string, std::vector<std::string>>>;

struct Expectation {
  std::string metric;
  double at_least = -std::numeric_limits<double>::infinity();
  double at_most = std::numeric_limits<double>::infinity();
  Selection where;
};

/// How far a metric may get worse than the baseline: the larger of the two.
struct Tolerance : Component {
  std::string pattern;  ///< a glob over names of metrics; the first that fits holds
  double relative = 0.05, absolute = 0;
  void params(ParamVisitor& v) override;
};

struct Spec : Component {
  std::filesystem::path file;
  std::string pipeline;              ///< the base; as written, relative to `file`
  std::vector<std::string> metrics;  ///< globs: the columns of tables; the first is the accuracy
  double time_limit = 3600;          ///< of a cell [s]
  int repeat = 1;                    ///< runs of a cell, with one seed each
  std::string baseline;              ///< as written, relative to `file`
  Pipeline base;
  std::vector<Dataset> datasets;
  std::vector<Axis> axes;
  std::vector<Selection> exclude;
  std::vector<Expectation> expect;
  std::vector<Tolerance> tolerances;

  void params(ParamVisitor& v) override;
  std::filesystem::path beside(const std::string& path) const;  ///< relative to the file
};

/// `matrix` knows every key, `batch` those that make sense without axes.
enum class Form { matrix, batch };

/// Reads the file and its base pipeline. Throws Error(config) with every mistake.
Spec load_spec(const std::filesystem::path& file, Form form);

/// Whether a glob such as "ate.*" fits the name.
bool fits(const std::string& pattern, const std::string& name);

}  // namespace cambium::matrix
