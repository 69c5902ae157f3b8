// SPDX-License-Identifier: BSD-3-Clause
// Plots of results as inline SVG.
#pragma once
#include "matrix/results.hpp"

namespace cambium::matrix {

/// One bar a cell of the dataset, for one metric.
std::string bar_plot(const Results& results, const std::string& dataset, const std::string& metric);

/// One point a cell of the dataset: what it took against how good it is.
std::string scatter_plot(const Results& results, const std::string& dataset,
                         const std::string& time, const std::string& metric);

}  // namespace cambium::matrix
