// SPDX-License-Identifier: BSD-3-Clause
// The tables of bench_scans.
#pragma once
#include <string>

#include "bench/registration_data.hpp"

namespace cambium::bench {

/// Scans with what a registration computed of each.
struct PreparedScans {
  std::vector<Scan> scans;
  std::vector<Prepared> prepared;
  std::vector<double> milliseconds;  ///< of preparing each
};
PreparedScans prepare(const Registration& method, std::vector<Scan> scans);

/// All pairs of the two missions below 30 m without a guess, by true baseline.
void global_table(const std::string& yaml);
/// gicp on scans that follow each other: time, and how well steps of one and of two agree.
void consecutive_table();
/// Pairs of places that never met: `stride` takes every so-many-th scan of the long mission.
void stranger_table(const std::string& yaml, std::size_t stride);
/// Whether the information matrix is honest: normalised error squared over simulated pairs.
void honesty_table(const std::string& yaml, int pairs, std::uint64_t seed = 5);

}  // namespace cambium::bench
