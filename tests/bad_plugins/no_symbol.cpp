// SPDX-License-Identifier: BSD-3-Clause
// An ordinary shared library.
#include "fixture.hpp"

FIXTURE_EXPORT const int something_else;
const int something_else = 1;
