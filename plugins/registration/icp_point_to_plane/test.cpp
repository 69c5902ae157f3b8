// SPDX-License-Identifier: BSD-3-Clause
#include "common/registration_laws.hpp"

namespace cambium::testing {

INSTANTIATE_TEST_SUITE_P(IcpPointToPlane, RegistrationLaws,
                         ::testing::Values(Method{"icp_point_to_plane", 0.02, 0.002}));

}  // namespace cambium::testing
