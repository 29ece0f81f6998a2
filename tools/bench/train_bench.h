// How fast the stages of training run on this machine, and how near that is to what it could do.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "cli/commands/bench.h"

namespace prospect::tools {

// Takes real steps (forward, backward, optimizer) of every stage, by the code that trains, on
// random trials in a temporary folder. Throws std::invalid_argument (task, device, precision) or
// std::runtime_error (no room for the folder).
//
// Keys: task, device, precision, threads, shards, matrix_product_gflops (MatrixPeakGflops), rows:
// one a stage with stage, batch, sample (what a sample of the batch is), samples_per_s,
// images_per_sample (pictures or hidden states whose loss is computed), images_per_s, forward and
// backward (multiply-adds a sample), gflops, peak_share, busy_cores (processor time a second),
// iterations (of the default configuration), minutes (that they take here), steps, seconds
// (measured).
nlohmann::json BenchTraining(const cli::BenchTrainOptions& options);

}  // namespace prospect::tools
