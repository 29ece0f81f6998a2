#pragma once

#include <string>

#include "agent/confidence.h"

namespace prospect::report {

/// Risk against coverage as an SVG element, with the threshold's place on it; empty for a curve of
/// fewer than two points.
std::string RiskChart(const agent::RefusalTerms& terms, double threshold);

}  // namespace prospect::report
