# SPDX-License-Identifier: BSD-3-Clause
# Inside this tree `find_package(cambium)` finds the targets that are already there, so that a plugin
# folder has one CMakeLists.txt for both worlds.
set(cambium_VERSION ${PROJECT_VERSION})
