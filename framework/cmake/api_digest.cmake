# SPDX-License-Identifier: BSD-3-Clause
# A digest of what the public headers declare (comments and white space aside). It stands in every
# plugin's ABI stamp: a plugin built against other declarations would be called through the wrong
# vtable slots, and would crash rather than be refused.
file(GLOB api_headers CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/include/cambium/*.hpp)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${api_headers})
set(api_text "")
foreach(header IN LISTS api_headers)
  file(READ ${header} text)
  string(REGEX REPLACE "//[^\n]*" "" text "${text}")
  string(REGEX REPLACE "[ \t\n]+" " " text "${text}")
  string(APPEND api_text "${text}")
endforeach()
string(SHA256 api_digest "${api_text}")
string(SUBSTRING ${api_digest} 0 8 api_digest)
set(CAMBIUM_GENERATED_INCLUDE ${CMAKE_CURRENT_BINARY_DIR}/include)
# Written only when it differs, so that a changed comment builds nothing again.
file(CONFIGURE OUTPUT ${CAMBIUM_GENERATED_INCLUDE}/cambium/api_digest.hpp CONTENT
"// SPDX-License-Identifier: BSD-3-Clause
// Made by framework/cmake/api_digest.cmake.
#pragma once
#include <cstdint>

namespace cambium {
inline constexpr std::uint32_t api_digest = 0x${api_digest}u;  ///< of the public headers
}
")
