#pragma once

#include "sim/image.h"

namespace prospect::report {

/// Where the redrawing differs from what was seen, brought to its light: white where it does by a
/// fifth of full range or more, black where it does not. Empty where either picture is missing or
/// their sizes differ.
sim::Image DifferenceMap(const sim::Image& seen, const sim::Image& redrawn);

}  // namespace prospect::report
