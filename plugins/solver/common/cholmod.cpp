// SPDX-License-Identifier: BSD-3-Clause
#include "common/cholmod.hpp"

namespace cambium::pose_solver {

cholmod_sparse view(const LowerPattern& pattern, const double* values) {
  cholmod_sparse A{};
  A.nrow = A.ncol = std::size_t(pattern.size());
  A.nzmax = pattern.row.size();
  A.p = const_cast<int*>(pattern.column_start.data());
  A.i = const_cast<int*>(pattern.row.data());
  A.x = const_cast<double*>(values);
  A.stype = -1;
  A.itype = CHOLMOD_INT;
  A.xtype = values ? CHOLMOD_REAL : CHOLMOD_PATTERN;
  A.dtype = CHOLMOD_DOUBLE;
  A.sorted = A.packed = 1;
  return A;
}

CholmodSettings::CholmodSettings() {
  cholmod_start(&common_);
  common_.print = 0;
  common_.error_handler = nullptr;
}

CholmodSettings::~CholmodSettings() { cholmod_finish(&common_); }

}  // namespace cambium::pose_solver
