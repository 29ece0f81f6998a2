#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "model/trial.h"

namespace prospect::model::segments {

/// Names of trials, and the numbers that stand for them.
using NamedTrials = std::map<std::string, std::uint64_t>;

/// The part of each trial, by its number. By a hash of their names a tenth is tested on and a tenth
/// only chooses settings (one each at least, of three trials or more). Where `held_out` names
/// trials, these are tested on instead: a name, its end ("B001"), or its beginning with a star
/// behind it ("Suturing_B*", all of one person's). Throws std::invalid_argument if one is not
/// among `trials`, or if none is left to train on.
std::map<std::uint64_t, Split> AssignParts(const NamedTrials& trials,
                                           const std::vector<std::string>& held_out);

}  // namespace prospect::model::segments
