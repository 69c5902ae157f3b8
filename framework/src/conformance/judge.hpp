// SPDX-License-Identifier: BSD-3-Clause
// Holds the components of a library against the laws. Each component runs in a process of its own:
// a plugin may crash, hang or print, and the report must still be written.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "plugins/loader.hpp"

namespace cambium::conformance {

enum class Outcome { holds, broken, not_applicable };

struct Finding {
  std::string component;  ///< "place_recognizer ring_key"; the file's name for laws of the library
  std::string law;
  Outcome outcome = Outcome::holds;
  std::string detail;
};

/// Laws of the file: it opens in this host and exports the descriptor only.
std::vector<Finding> judge_library(const std::filesystem::path& library);

/// All laws of one component, in this process. Every line is written to `record` before and after
/// its law is checked, so that a reader of the file knows where a crash happened.
void judge_here(const Registered& registered, const Registry& registry,
                const std::filesystem::path& record);

/// The findings of a record, those of a process that ended as `ending` says ("signal 11", "was
/// stopped after 120 s", or nothing when it ended well), and that printed `printed`.
std::vector<Finding> read_record(const std::string& component, const std::string& record,
                                 const std::string& ending, const std::string& printed);

}  // namespace cambium::conformance
