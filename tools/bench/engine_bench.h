#pragma once

#include <nlohmann/json_fwd.hpp>

#include "cli/commands/bench.h"

namespace prospect::tools {

/// How fast the engine answers on one core, beside libtorch's and beside the machine's large matrix
/// products. Everything is in processor time of one thread, so that a busy machine disturbs little
/// (it still shares caches). Throws what loading the weights throws.
///
/// Keys: task, weights, engine, pairs, matrix_product_gflops, rows: one a batch size with batch, ms
/// and torch_ms (a row), ratio, multiply_adds (a row, windows inside the map, after folding) and
/// peak_share; encode and decode, each with ms, torch_ms and ratio; layers: one a layer and batch
/// size with layer, batch, us (a row), multiply_adds and peak_share; agreement: scenes and the
/// fields of EngineAgreement. Winograd's filtering needs fewer products than are counted, so a
/// share may exceed 1.
nlohmann::json BenchEngine(const cli::BenchEngineOptions& options);

}  // namespace prospect::tools
