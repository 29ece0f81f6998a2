#pragma once

#include <cstdint>
#include <string>

#include "model/engine.h"
#include "model/network_config.h"
#include "model/weights_file.h"

namespace prospect::model {

/// What an engine that runs a weights file's networks says of itself: `engine` is its name,
/// `judges` whether it holds V, Q, p and f. Throws WeightsError for a calibration that cannot be
/// read.
EngineInfo InfoOf(const WeightsFile& file, const std::string& path, const NetworkConfig& config,
                  const std::string& engine, bool judges);

/// A hash of the bits of its answer to one fixed question: a gradient picture, the first action.
/// Engines that round otherwise answer otherwise (Engine::fingerprint).
std::uint64_t HashOfProbe(Engine& engine);

}  // namespace prospect::model
