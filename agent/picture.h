#pragma once

#include "sim/image.h"

namespace prospect::agent {

/// A picture as it travels on the bus; empty when there is none.
using Picture = sim::Image;

}  // namespace prospect::agent
