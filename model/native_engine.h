#pragma once

#include <memory>
#include <string>

#include "model/engine.h"
#include "model/inference/kernels.h"

namespace prospect::model {

/// LoadEngine (model/engine.h) with the kernels of one instruction set, which the processor must
/// have: for tests and measurements.
std::unique_ptr<Engine> LoadNativeEngine(const std::string& path, int threads,
                                         const inference::Kernels& kernels);

}  // namespace prospect::model
