// SPDX-License-Identifier: BSD-3-Clause
// The library that missing_dependency.cpp is linked with.
__attribute__((visibility("default"))) int from_a_library_that_is_gone();
int from_a_library_that_is_gone() { return 1; }
