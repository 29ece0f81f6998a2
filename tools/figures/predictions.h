#pragma once

#include <vector>

#include "report/page.h"
#include "tools/figures/loaded_model.h"
#include "tools/figures/task_table.h"
#include "tools/figures/variants.h"

namespace prospect::figures {

/// `count` chains of held-out trials in an order that `seed` decides, several of one trial where
/// there are few trials; their first actions differ as far as that goes.
std::vector<Chain> DrawnChains(const HeldOut& held_out, int count, std::uint64_t seed);

/// predictions.png (the paper's figure of its third domain): what was seen, what is imagined after
/// the action under way and after the next one, and what the camera then really saw; an example a
/// row, with the mean absolute errors and those of copying what was seen.
report::Page DrawPredictions(const std::vector<Chain>& chains, const TaskTable& table,
                             const LoadedModel& own);

/// reconstructions.png (the paper's figure of pretraining): pictures of held-out trials above,
/// decode(encode(picture)) below, in the picture's light.
report::Page DrawReconstructions(const std::vector<sim::Image>& pictures, const LoadedModel& own);

/// `count` pictures of held-out trials that `seed` draws, as they are seen.
std::vector<sim::Image> DrawnPictures(const HeldOut& held_out, int count, std::uint64_t seed);

}  // namespace prospect::figures
