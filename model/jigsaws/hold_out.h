#pragma once

#include <map>
#include <string>
#include <vector>

#include "model/jigsaws/trial_labels.h"

namespace prospect::model::jigsaws {

/// Which trials are not trained on.
struct HoldOut {
  int trials = 3;                  ///< so many are tested on, by a hash of their names, or
  std::vector<std::string> names;  ///< these, such as "B001" or "Suturing_B001", or
  char user = 0;                   ///< all of this user's (leave one user out)
  int valid = 3;                   ///< of the others, by hash, so many only choose settings
};

/// The part of each trial, by seed. Throws std::invalid_argument if a trial or user asked for is
/// not among `trials`, or if none is left to train on.
std::map<std::uint64_t, Split> AssignParts(const std::vector<TrialName>& trials,
                                           const HoldOut& hold_out);

}  // namespace prospect::model::jigsaws
