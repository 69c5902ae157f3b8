// SPDX-License-Identifier: BSD-3-Clause
// What scripts return, as the host wants it. Called under the lock; std::runtime_error says what a
// method returned and what was expected of it.
#pragma once
#include <filesystem>

#include "cambium/kinds.hpp"
#include "interpreter.hpp"

namespace cambium::python {

Payload to_payload(const py::object& returned, const std::string& what);
Fingerprints to_fingerprints(const py::object& returned, std::size_t nodes);
std::vector<Candidate> to_candidates(const py::object& returned);
Alignment to_alignment(const py::object& returned);
std::vector<std::filesystem::path> to_paths(const py::object& returned);
/// Names get `prefix` in front.
std::vector<Metric> to_metrics(const py::object& returned, const std::string& prefix);
Mission to_mission(const py::object& returned, const std::filesystem::path& path,
                   const std::string& script);

}  // namespace cambium::python
