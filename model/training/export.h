#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "model/training/trainer.h"
#include "model/weights.h"

namespace prospect::model {

/// Writes what was trained: DIR/TASK.safetensors (all that planning needs) and
/// DIR/TASK-classifiers.safetensors (C and the second classifier, which only scores need), both
/// without those networks that were not trained, with configuration, data hash, seeds of the first
/// and last trial, command, the same of weights it began from (`history`), code version, scores
/// and calibration in their metadata. The
/// calibration's refusal_threshold is the plan score that best separates successful from failed
/// validation trials. Returns the path of the first. Throws WeightsError.
std::string ExportWeights(const Trainer& trainer, const nlohmann::json& scores);

/// DIR/TASK-classifiers.safetensors for DIR/TASK.safetensors.
std::string ClassifiersPath(const std::string& weights);

/// Takes all networks from a weights file and the classifiers' file beside it, into inference mode
/// on the CPU; the has_ flags of Networks say what was there. (A file without C is BundleWeights'.)
/// Throws WeightsError.
void LoadNetworks(const std::string& weights, Networks* networks);

/// Whether a weights file was trained with the classifiers that read labels; without, there is no
/// classifiers' file beside it.
bool ReadsLabels(const WeightsFile& weights);

/// Copies a weights file and the classifiers' file beside it into `folder`, without C, which only
/// training needs. Throws WeightsError.
void BundleWeights(const std::string& weights, const std::string& folder);

}  // namespace prospect::model
