// SPDX-License-Identifier: BSD-3-Clause
#include "common/noise.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "cambium/statistics.hpp"

namespace cambium::gnss {
namespace {

/// Unit variance: `white` of it without memory, the rest with memory of `time` [s].
struct Model {
  double time, white;
};

/// What a model makes of the residuals.
struct Judgement {
  double log_likelihood = 0, variance = 0;         ///< variance: of the residuals, profiled
  double yaw_variance = 0, position_variance = 0;  ///< of the closed form [rad^2, m^2]
};

/// Moments of the closed form, which weighs every fix by its stated variance.
struct Moments {
  double turn = 0, move = 0;  ///< sums of |per_radian|^2 and per_metre^2
  std::size_t fixes = 0;
};

Moments moments(const std::vector<Series>& all) {
  Moments m;
  for (const Series& series : all)
    for (const Whitened& w : series) {
      m.turn += w.per_radian.squaredNorm();
      m.move += w.per_metre * w.per_metre;
      ++m.fixes;
    }
  return m;
}

/// Innovations of a scalar Kalman filter; its gains depend on times only, so all columns of both
/// axes share them.
class Likelihood {
 public:
  void add(const Series& series, const Model& model) {
    Columns predicted = Columns::Zero();
    double P = 1 - model.white, before = series.front().seconds;
    for (const Whitened& w : series) {
      const double memory = std::exp(-(w.seconds - before) / model.time);
      before = w.seconds;
      predicted *= memory;
      P = memory * memory * P + (1 - memory * memory) * (1 - model.white);
      Columns values;
      values << w.per_metre, w.per_radian, w.residual;
      const double S = P + model.white;
      const Columns innovation = values - predicted;
      accumulate(innovation / std::sqrt(S));
      log_determinant_ += 2 * std::log(S);  // two axes
      predicted += P / S * innovation;
      P *= 1 - P / S;
    }
  }

  void judge(double freedom, Judgement& out) const {
    const Eigen::LDLT<Eigen::Matrix3d> normal(normal_);
    const double explained = right_.dot(normal.solve(right_));
    // Exact data has residuals of rounding only; the logarithm must not see zero.
    out.variance = std::max(squares_ - explained, 1e-18) / freedom;
    out.log_likelihood = -0.5 * (freedom * std::log(out.variance) + log_determinant_ +
                                 normal.vectorD().array().abs().max(1e-300).log().sum());
  }

 private:
  using Columns = Eigen::Matrix<double, 5, 1>;  // per_metre, per_radian x y, residual x y

  void accumulate(const Columns& c) {
    for (int axis = 0; axis < 2; ++axis) {
      Eigen::Vector3d row(axis == 0 ? c[0] : 0, axis == 1 ? c[0] : 0, c[1 + axis]);
      normal_ += row * row.transpose();
      right_ += c[3 + axis] * row;
      squares_ += c[3 + axis] * c[3 + axis];
    }
  }

  Eigen::Matrix3d normal_ = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right_ = Eigen::Vector3d::Zero();
  double squares_ = 0, log_determinant_ = 0;
};

/// Variances of sum per_radian . e and sum per_metre * e for errors e of the model, by recursion.
void propagate(const Series& series, const Model& model, double& turn, double& move) {
  Eigen::Vector3d past = Eigen::Vector3d::Zero();  // earlier gains, faded
  double before = series.front().seconds;
  for (const Whitened& w : series) {
    past *= std::exp(-(w.seconds - before) / model.time);
    before = w.seconds;
    const Eigen::Vector3d gain(w.per_radian.x(), w.per_radian.y(), w.per_metre);
    const Eigen::Vector3d sum = gain.cwiseProduct(gain + 2 * (1 - model.white) * past);
    turn += sum.x() + sum.y();
    move += sum.z();
    past += gain;
  }
}

Judgement judge(const std::vector<Series>& all, const Moments& m, const Model& model) {
  Likelihood likelihood;
  Judgement out;
  double turn = 0, move = 0;
  for (const Series& series : all) {
    likelihood.add(series, model);
    propagate(series, model, turn, move);
  }
  likelihood.judge(2 * double(m.fixes) - 3, out);
  out.yaw_variance = out.variance * turn / (m.turn * m.turn);
  out.position_variance = out.variance * move / (m.move * m.move);
  return out;
}

/// Correlation times from a quarter of the usual step to half of the longest series.
std::vector<Model> candidates(const std::vector<Series>& all) {
  double longest = 0;
  std::vector<double> steps;
  for (const Series& series : all) {
    longest = std::max(longest, series.back().seconds - series.front().seconds);
    for (std::size_t i = 1; i < series.size(); ++i)
      steps.push_back(series[i].seconds - series[i - 1].seconds);
  }
  const double step = steps.empty() ? 0 : median(std::move(steps));
  if (!(step > 0)) return {{1, 1}};
  constexpr int times = 14;
  const double shortest = step / 4, ratio = std::max(longest / 2 / shortest, 1.0);
  std::vector<Model> out;
  for (int k = 0; k < times; ++k)
    for (const double white : {0.001, 0.05, 0.2, 0.5, 0.8})  // not 0: stamps may repeat
      out.push_back({shortest * std::pow(ratio, k / double(times - 1)), white});
  return out;
}

}  // namespace

Noise model_noise(const std::vector<Series>& all) {
  const Moments m = moments(all);
  const std::vector<Model> models = candidates(all);
  std::vector<Judgement> judged;
  for (const Model& model : models) judged.push_back(judge(all, m, model));
  double best = -std::numeric_limits<double>::infinity();
  for (const Judgement& j : judged) best = std::max(best, j.log_likelihood);
  double total = 0, variance = 0, yaw = 0, position = 0, log_time = 0;
  for (std::size_t k = 0; k < models.size(); ++k) {
    const double p = std::exp(judged[k].log_likelihood - best);
    total += p;
    variance += p * judged[k].variance;
    yaw += p * judged[k].yaw_variance;
    position += p * judged[k].position_variance;
    log_time += p * std::log(models[k].time);
  }
  Noise out;
  out.scale = std::sqrt(variance / total);
  out.correlation_time = std::exp(log_time / total);
  out.sigma_yaw = std::numeric_limits<double>::infinity();
  if (m.turn > 0) {
    out.effective_fixes = double(m.fixes) * (variance / m.turn) / yaw;
    out.sigma_yaw = std::sqrt(std::max(yaw / total, 1 / m.turn));
  }
  out.sigma_position = std::sqrt(std::max(position / total, 1 / m.move));
  return out;
}

}  // namespace cambium::gnss
