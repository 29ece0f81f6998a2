#pragma once

#include <cstdint>
#include <string>

#include "model/dataset.h"
#include "sim/image.h"
#include "sim/task.h"

namespace prospect::tools {

// A contact sheet: a title that says of which file, task and draw it is; `rows` trials drawn at
// random by `seed`, a row each under its scene's seed, with the first picture of every segment and
// the trial's last; the action's name under each, the verdict under the last. At most
// 1,900 pixels wide: a row of more pictures goes on below. `spec`: the table that the file was
// recorded with; null: numbers in the place of names.
// Throws model::DataError if the file has no trials.
sim::Image ContactSheet(const model::TrialFile& file, const sim::TaskSpec* spec, std::size_t rows,
                        std::uint64_t seed);

}  // namespace prospect::tools
