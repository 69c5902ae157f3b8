// SPDX-License-Identifier: BSD-3-Clause
#include "correlation.hpp"

#include <bit>
#include <cmath>
#include <numbers>

namespace scan_context {
namespace {

using RowMajor = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

double angle(int sectors, std::size_t frequency, int s) {
  // The product is reduced first: cos and sin lose digits at large arguments.
  return 2.0 * std::numbers::pi * double((frequency * std::size_t(s)) % std::size_t(sectors)) /
         sectors;
}

}  // namespace

Spectra::Spectra(const cambium::Fingerprints& fingerprints, std::size_t first, int rings,
                 int sectors)
    : size_(fingerprints.rows),
      words_((std::size_t(sectors) + 63) / 64),
      sectors_(sectors),
      spectrum_(std::size_t(sectors) / 2 + 1, Eigen::MatrixXf(2 * rings, Eigen::Index(size_))),
      filled_(size_ * words_, 0),
      filled_count_(size_, 0) {
  Eigen::MatrixXf real(sectors, spectrum_.size()), imaginary(sectors, spectrum_.size());
  for (std::size_t f = 0; f < spectrum_.size(); ++f)
    for (int s = 0; s < sectors; ++s) {
      real(s, Eigen::Index(f)) = float(std::cos(angle(sectors, f, s)));
      imaginary(s, Eigen::Index(f)) = float(-std::sin(angle(sectors, f, s)));
    }
  for (std::size_t i = 0; i < size_; ++i) {
    const Eigen::Map<const Eigen::MatrixXf> columns(&fingerprints.row(i)[first], rings, sectors);
    transform(i, columns, real, imaginary);
    mark_filled(i, columns);
  }
}

void Spectra::transform(std::size_t node, const Eigen::Ref<const Eigen::MatrixXf>& columns,
                        const Eigen::MatrixXf& real, const Eigen::MatrixXf& imaginary) {
  const Eigen::MatrixXf above = columns * real, below = columns * imaginary;
  for (std::size_t f = 0; f < spectrum_.size(); ++f)
    spectrum_[f].col(Eigen::Index(node)) << above.col(Eigen::Index(f)), below.col(Eigen::Index(f));
}

void Spectra::mark_filled(std::size_t node, const Eigen::Ref<const Eigen::MatrixXf>& columns) {
  for (int s = 0; s < sectors_; ++s) {
    if (columns.col(s).isZero(0)) continue;
    filled_[node * words_ + std::size_t(s) / 64] |= std::uint64_t(1) << (s % 64);
    ++filled_count_[node];
  }
}

Correlator::Correlator(const Spectra& query, const Spectra& reference)
    : query_(query),
      reference_(reference),
      inverse_(query.sectors(), 2 * Eigen::Index(query.frequencies())) {
  const int sectors = query.sectors();
  for (std::size_t f = 0; f < query.frequencies(); ++f) {
    const bool own_mirror = f == 0 || 2 * f == std::size_t(sectors);
    const double weight = (own_mirror ? 1.0 : 2.0) / sectors;
    for (int k = 0; k < sectors; ++k) {
      inverse_(k, 2 * Eigen::Index(f)) = float(weight * std::cos(angle(sectors, f, k)));
      inverse_(k, 2 * Eigen::Index(f) + 1) = float(-weight * std::sin(angle(sectors, f, k)));
    }
  }
}

Eigen::MatrixXf Correlator::correlate(Range queries, Range references) const {
  const auto nq = Eigen::Index(queries.size()), nr = Eigen::Index(references.size());
  RowMajor cross(inverse_.cols(), nq * nr);  // conj(Q) R, summed over rings; two rows a frequency
  for (std::size_t f = 0; f < query_.frequencies(); ++f) {
    const auto Q = query_.at(f).middleCols(Eigen::Index(queries.begin), nq);
    const auto R = reference_.at(f).middleCols(Eigen::Index(references.begin), nr);
    const auto rings = Q.rows() / 2;
    Eigen::Map<RowMajor> real(cross.row(2 * Eigen::Index(f)).data(), nq, nr);
    Eigen::Map<RowMajor> imaginary(cross.row(2 * Eigen::Index(f) + 1).data(), nq, nr);
    real.noalias() = Q.transpose() * R;
    imaginary.noalias() = Q.topRows(rings).transpose() * R.bottomRows(rings);
    imaginary.noalias() -= Q.bottomRows(rings).transpose() * R.topRows(rings);
  }
  return inverse_ * cross;
}

Overlap::Overlap(const Spectra& query, std::size_t node)
    : words_(query.filled(node).size()), shifted_(std::size_t(query.sectors()) * words_, 0) {
  const auto sectors = std::size_t(query.sectors());
  const auto filled = query.filled(node);
  for (std::size_t s = 0; s < sectors; ++s) {
    if (!(filled[s / 64] >> (s % 64) & 1)) continue;
    for (std::size_t k = 0; k < sectors; ++k) {
      const std::size_t to = (s + k) % sectors;
      shifted_[k * words_ + to / 64] |= std::uint64_t(1) << (to % 64);
    }
  }
}

int Overlap::count(int shift, std::span<const std::uint64_t> reference) const {
  int n = 0;
  for (std::size_t w = 0; w < words_; ++w)
    n += std::popcount(shifted_[std::size_t(shift) * words_ + w] & reference[w]);
  return n;
}

}  // namespace scan_context
