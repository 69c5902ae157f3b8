// SPDX-License-Identifier: BSD-3-Clause
#include <pcl/console/print.h>

#include "pcl.hpp"

namespace cambium::registration {

void silence_pcl() { pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS); }

}  // namespace cambium::registration
