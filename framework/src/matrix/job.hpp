// SPDX-License-Identifier: BSD-3-Clause
// One run of a cell as a command and the files it leaves.
#pragma once
#include "engine/child.hpp"
#include "matrix/run_cells.hpp"
#include "matrix/schedule.hpp"

namespace cambium::matrix {

struct Job {
  std::size_t cell = 0;
  std::uint64_t seed = 0;
  std::string name;  ///< of the cell; of other runs than the first with the seed behind it
  Steps steps;
  std::vector<std::string> command;  ///< without threads and memory
  std::filesystem::path out, log;
};

/// Writes the cell's pipeline beside its run folder, so that `cambium run` repeats it by hand.
Job make_job(const Cell& cell, std::size_t index, const std::vector<std::string>& missions,
             std::uint64_t seed, const RunSettings& settings);

/// Reads what the job left behind.
CellRun read_job(const Job& job, const Child::Outcome& outcome);

}  // namespace cambium::matrix
