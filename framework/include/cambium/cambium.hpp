// SPDX-License-Identifier: BSD-3-Clause
// Everything of the public API at once.
#pragma once
#include "cambium/dialect.hpp"
#include "cambium/files.hpp"
#include "cambium/geodesy.hpp"
#include "cambium/plugin.hpp"
