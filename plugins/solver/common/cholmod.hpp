// SPDX-License-Identifier: BSD-3-Clause
// CHOLMOD, quiet and with an owner.
#pragma once
#include <cholmod.h>

#include <vector>

namespace cambium::pose_solver {

/// The lower triangle, column by column, rows ascending. The diagonal is full.
struct LowerPattern {
  std::vector<int> column_start;  ///< one more than there are columns
  std::vector<int> row;
  int size() const { return int(column_start.size()) - 1; }
};

/// CHOLMOD's view of a matrix, `values` as `pattern.row`, null for the pattern alone; owns nothing.
cholmod_sparse view(const LowerPattern& pattern, const double* values);

class CholmodSettings {
 public:
  CholmodSettings();
  ~CholmodSettings();
  CholmodSettings(const CholmodSettings&) = delete;
  CholmodSettings& operator=(const CholmodSettings&) = delete;
  cholmod_common* operator->() { return &common_; }
  operator cholmod_common*() { return &common_; }

 private:
  cholmod_common common_{};
};

}  // namespace cambium::pose_solver
