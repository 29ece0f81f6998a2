#pragma once

#include "sim/image.h"

namespace prospect::services {

/// A picture as it travels on the bus; empty when there is none.
using Picture = sim::Image;

}  // namespace prospect::services
