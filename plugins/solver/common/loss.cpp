// SPDX-License-Identifier: BSD-3-Clause
#include "common/loss.hpp"

#include <algorithm>
#include <cmath>

namespace cambium::pose_solver {

const std::vector<std::string>& loss_names() {
  static const std::vector<std::string> names = {"none",          "huber", "cauchy",
                                                 "geman_mcclure", "dcs",   "switchable"};
  return names;
}

LossKind loss_from(const std::string& name) {
  const auto& names = loss_names();
  return LossKind(std::find(names.begin(), names.end(), name) - names.begin());
}

void Loss::evaluate(double s, double rho[3]) const {
  rho[0] = s, rho[1] = 1, rho[2] = 0;
  switch (kind_) {
    case LossKind::none:
      break;
    case LossKind::huber:
      if (s <= w2_) break;
      rho[0] = 2 * std::sqrt(w2_ * s) - w2_;
      rho[1] = std::sqrt(w2_ / s);
      rho[2] = -0.5 * rho[1] / s;
      break;
    case LossKind::cauchy: {
      const double u = 1 + s / w2_;
      rho[0] = w2_ * std::log(u);
      rho[1] = 1 / u;
      rho[2] = -rho[1] * rho[1] / w2_;
      break;
    }
    case LossKind::switchable:  // min over b of switched(s, b)
    case LossKind::geman_mcclure: {
      const double u = w2_ / (w2_ + s);
      rho[0] = u * s;
      rho[1] = u * u;
      rho[2] = -2 * rho[1] / (w2_ + s);
      break;
    }
    case LossKind::dcs: {
      if (s <= w2_) break;
      const double u = 2 * w2_ / (w2_ + s);
      rho[0] = w2_ * (3 * s - w2_) / (w2_ + s);
      rho[1] = u * u;
      rho[2] = -2 * rho[1] / (w2_ + s);
      break;
    }
  }
}

double Loss::value(double s) const {
  double rho[3];
  evaluate(s, rho);
  return rho[0];
}

double Loss::weight(double s) const {
  double rho[3];
  evaluate(s, rho);
  return rho[1];
}

}  // namespace cambium::pose_solver
