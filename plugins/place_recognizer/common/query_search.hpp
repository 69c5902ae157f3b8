// SPDX-License-Identifier: BSD-3-Clause
// One query against tile after tile. What the bytes of a tile say of a distance lies within bounds;
// a shift of a pair is kept while its lower bound is not above the upper bounds of as many
// references as are wanted. At the end sums in float narrow the bounds of what was kept, and the
// definition decides among what is still left.
#pragma once
#include "common/filled.hpp"
#include "common/search.hpp"

namespace columns {

/// Far above the rounding errors of the definition, far below what the bytes are off by.
constexpr double slack = 1e-9;

/// What all queries share.
struct Task {
  Table references;
  const cambium::Pairing& pairing;
  Limits limits;
  const Kernel& kernel;
  InverseTransform inverse;
};

/// The smallest of many distances, as many as are wanted.
class Smallest {
 public:
  Smallest(std::size_t count, double limit) : count_(count), limit_(limit) {}
  void add(double distance);
  /// Greater distances are not among them, nor below the limit.
  double bar() const { return heap_.size() < count_ ? limit_ : std::min(limit_, heap_.front()); }

 private:
  std::size_t count_;
  double limit_;
  std::vector<double> heap_;  // the largest first
};

/// Between the parts of a kernel, for the queries that a thread takes through the tiles at once.
struct Scratch {
  Scratch(Shape shape, std::size_t descriptors)
      : cross(shape.frequencies() * 2 * lanes),
        spectra(descriptors * cross),
        sums(std::size_t(shape.sectors) * lanes) {}
  std::size_t cross;  ///< numbers of the cross spectra of a descriptor
  std::vector<float> spectra, sums;
  std::vector<Screening> screenings;
};

class QuerySearch {
 public:
  QuerySearch(const Task& task, const Table& queries, std::size_t query,
              const Transform& transform);
  /// Adds what is to be asked of a tile: a screening for each view, or none where the mission's
  /// own nodes are too near.
  void ask(std::size_t tile, Scratch& scratch);
  /// Takes the answers to these questions, about the same tile, from the front of `answers`.
  void look_at(std::size_t tile, std::span<Screening>& answers, std::vector<float>& sums);
  std::vector<Match> matches();

 private:
  struct View {
    std::span<const float> descriptor;
    CoarseQuery coarse;
  };
  struct Plausible {  // one shift of one pair
    double lower;     // bound of its distance
    std::uint32_t reference;
    std::uint16_t view, shift;
  };
  unsigned allowed_lanes(std::size_t tile) const;
  int columns_in_common(const View& view, std::size_t reference, std::size_t shift) const;
  /// Narrows the bounds of what was kept; less is left.
  void narrow();
  double distance_at(const View& view, std::size_t reference, std::size_t shift) const;
  /// Keeps what is plausible of a pair; lowers `upper`, the bound of its distance.
  void keep_plausible(std::size_t view, std::size_t reference, const float* sums, double& upper);
  std::vector<std::span<const Plausible>> by_reference() const;
  Match best_of(std::span<const Plausible> of_reference) const;
  double refined(const Match& match, std::size_t shift) const;

  const Task& task_;
  std::size_t query_;
  double least_columns_;
  unsigned allowed_ = 0;  // lanes of the tile that was asked about
  std::vector<View> views_;
  Smallest nearest_;  // upper bounds
  std::vector<Plausible> plausible_;
  std::vector<int> in_common_;  // by shift
};

}  // namespace columns
