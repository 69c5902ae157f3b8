// SPDX-License-Identifier: BSD-3-Clause
#include "common/registration_laws.hpp"

namespace cambium::testing {

INSTANTIATE_TEST_SUITE_P(Gicp, RegistrationLaws, ::testing::Values(Method{"gicp", 0.02, 0.002}));

}  // namespace cambium::testing
