#pragma once

#include "report/page.h"
#include "tools/figures/judgements.h"

namespace prospect::figures {

/// calibration.png: for V, Q, p and f (rows), of seen states and after one and two transforms
/// (columns), what was predicted against how often it came true, with the counts.
report::Page DrawCalibration(const HeadRecord& record, int trials, const std::string& task);

}  // namespace prospect::figures
