#include "cambium/kinds.hpp"
