#pragma once

#include <string>

namespace prospect::model {
class TrialFile;
}

namespace prospect::model::robomimic {

/// Writes a data set as robomimic reads one:
///
///   data                    attributes total (frames), env_args (JSON: env_name, type, env_kwargs)
///   data/demo_SEED          attribute num_samples
///     obs/agentview_image   uint8 [N,H,W,3]
///     next_obs/...          the same a frame later, the last one twice; only on request
///     actions               float32 [N,A]: 1 for the action that is done from this frame to the
///                           next, else 0
///     rewards, dones        float32 [N], uint8 [N]
///   mask/train, valid, test names of the demonstrations of each part
///
/// What it has no place for (which frames an action ran over, and whether it succeeded) is a
/// table beside it: SegmentTable(). Atomic. Throws DataError, DiskError.
void Export(const TrialFile& trials, const std::string& out, bool next_obs);

/// Lines "demo,start,end,action,succeeded,cause" for segments::ReadDemoCsv(). Throws DataError.
std::string SegmentTable(const TrialFile& trials);

}  // namespace prospect::model::robomimic
