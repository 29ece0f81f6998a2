#pragma once

#include <string>
#include <vector>

#include "tools/verify/figures.h"

namespace prospect::verify {

/// The tables of a Markdown text in which none of the measurements' figures is printed, each named
/// by its heading and the first cell of its first row: "Networks on stacking: x1".
std::vector<std::string> TablesNotMeasured(const std::string& markdown,
                                           const std::vector<Measurement>& measurements);

}  // namespace prospect::verify
