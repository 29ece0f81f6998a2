#pragma once

#include "lcmtypes/messages.h"
#include "model/refusal/sample.h"

namespace prospect::services {

// CALIBRATION between the wire and the model room. Pure functions, safe from any thread.

/// All fields of the message but utime, ids and task. Scores lose what a 32-bit float does not
/// hold.
void SetSample(const model::CalibrationSample& sample, calibration_t* message);

/// The sample of a message that passed Validate.
model::CalibrationSample SampleFrom(const calibration_t& message);

}  // namespace prospect::services
