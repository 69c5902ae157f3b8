// SPDX-License-Identifier: BSD-3-Clause
// Runs the command line as a user would.
#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace cambium::testing {

struct Outcome {
  int code = 0;  ///< exit code; 128 + n when a signal n ended the process
  std::string out, err;
};

/// `cambium ARGUMENTS...` with the plugins of this build and no cache unless the arguments name
/// one.
Outcome run_cambium(const std::vector<std::string>& arguments);

/// The same, sent a signal when `moment` returns, which sleeps or waits for what the run does.
Outcome run_cambium_interrupted(const std::vector<std::string>& arguments,
                                const std::function<void()>& moment, int signal);

/// The same where no file can become larger than `largest_file` bytes.
Outcome run_cambium_on_full_disk(const std::vector<std::string>& arguments,
                                 std::size_t largest_file);

nlohmann::json read_json(const std::filesystem::path& path);

/// The value of a metric in a report.json; fails the test when it is absent.
double metric(const nlohmann::json& report, const std::string& name);

std::string pipeline(const std::string& name);  ///< path of a shipped pipeline

}  // namespace cambium::testing
