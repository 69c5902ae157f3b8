// SPDX-License-Identifier: BSD-3-Clause
#include "matrix/spec.hpp"

#include <fnmatch.h>

namespace cambium::matrix {

void Dataset::params(ParamVisitor& v) {
  v("name", name, "Short name, for tables and folders: letters, digits, '_', '-', '.'");
  v("missions", missions, "Folders, .g2o files or globs, relative to this file or in the archive");
  v("archive", archive, "A tar archive that holds the missions, relative to this file");
  v("simulate", simulate, "Specification of missions to simulate instead, see docs/simulate.md");
  v("optional", optional, "Leave it out, and say so, when its missions are not there");
}

std::string Dataset::check_params() const {
  if (name.empty()) return "a dataset needs a 'name'";
  if (missions.empty() == simulate.empty())
    return "a dataset needs either 'missions' or 'simulate'";
  if (!archive.empty() && !simulate.empty())
    return "an archive holds missions; it is not simulated";
  return {};
}

void Tolerance::params(ParamVisitor& v) {
  v("relative", relative, "Of the baseline's value", at_least(0));
  v("absolute", absolute, "In the unit of the metric", at_least(0));
}

void Spec::params(ParamVisitor& v) {
  v("pipeline", pipeline, "The base pipeline, relative to this file");
  v("metrics", metrics,
    "Columns of the tables, such as 'ate.rmse' or 'loops.*'; the first is plotted against time");
  v("time_limit", time_limit, "A cell that takes longer is stopped and reported", above(0, "s"));
  v("repeat", repeat, "Runs of each cell, with one seed each", between(1, 1000));
  v("baseline", baseline, "Results to compare with, written by --update-baseline");
}

std::filesystem::path Spec::beside(const std::string& path) const {
  return (std::filesystem::absolute(file).parent_path() / path).lexically_normal();
}

bool fits(const std::string& pattern, const std::string& name) {
  return ::fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
}

}  // namespace cambium::matrix
