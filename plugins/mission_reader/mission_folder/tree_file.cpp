// SPDX-License-Identifier: BSD-3-Clause
#include "tree_file.hpp"

#include <limits>

#include "common/csv_table.hpp"

namespace cambium {
namespace {

// Up along the stem: a detector may fit an axis that points down.
Vec3 axis_of(const CsvTable& table, std::size_t row) {
  Vec3 axis(table.number(row, "axis_x"), table.number(row, "axis_y"), table.number(row, "axis_z"));
  const double norm = axis.norm();
  if (!(norm > 1e-6)) table.fail(row, "the axis has no length, expected a direction");
  return (axis.z() < 0 ? -1 : 1) * axis / norm;
}

double dbh_of(const CsvTable& table, std::size_t row) {
  const std::string& text = table.text(row, "dbh");
  if (text.empty() || text == "nan" || text == "NaN")
    return std::numeric_limits<double>::quiet_NaN();
  const double dbh = table.number(row, "dbh");
  if (dbh < 0) table.fail(row, "found dbh " + text + ", expected a diameter in metres or nothing");
  return dbh;
}

double score_of(const CsvTable& table, std::size_t row) {
  const double score = table.number(row, "score");
  if (score < 0 || score > 1)
    table.fail(row, "found score " + table.text(row, "score") + ", expected 0..1");
  return score;
}

}  // namespace

std::vector<Tree> load_trees(const std::filesystem::path& path) {
  const CsvTable table(path);
  table.require({"x", "y", "z"});
  const bool has_axis = table.has("axis_x") && table.has("axis_y") && table.has("axis_z");
  const bool has_dbh = table.has("dbh"), has_score = table.has("score");
  const bool has_reconstructed = table.has("reconstructed");
  std::vector<Tree> trees(table.rows());
  for (std::size_t row = 0; row < trees.size(); ++row) {
    Tree& tree = trees[row];
    tree.base = Vec3(table.number(row, "x"), table.number(row, "y"), table.number(row, "z"));
    if (has_axis) tree.axis = axis_of(table, row);
    tree.dbh = has_dbh ? dbh_of(table, row) : std::numeric_limits<double>::quiet_NaN();
    tree.score = has_score ? score_of(table, row) : 1.0;
    if (has_reconstructed) tree.reconstructed = table.integer(row, "reconstructed") != 0;
  }
  return trees;
}

}  // namespace cambium
