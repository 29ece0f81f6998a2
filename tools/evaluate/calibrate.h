#pragma once

#include <map>
#include <string>
#include <vector>

#include "base/exit_error.h"
#include "cli/options/promise.h"
#include "model/calibration.h"
#include "model/refusal/promise.h"
#include "model/refusal/scene_kind.h"
#include "planner/search_parameters.h"
#include "sim/task.h"
#include "tools/evaluate/report.h"

namespace prospect::tools {

// What a command line asks for.
model::Promise PromiseOf(const cli::PromiseOptions& options);

// How the planner's row fared, as a calibration keeps it; scenes solved at the start are left out.
// The records were made with nothing refused. Throws std::invalid_argument where one lacks the
// planner's score, class or ending.
model::CalibrationSample SampleFrom(const std::vector<SceneRecord>& scenes);

// What kind of scene the task stands at.
model::SceneKind KindOf(const sim::Task& task);

// What a search must share with the calibration to be covered by it, by name.
std::map<std::string, double> CoveredParameters(const planner::SearchParameters& search,
                                                const model::SceneKind& kind, int retries);

// Makes a threshold that is to be the weights' own (below 0) the one of their calibration on scenes
// of this kind. Where they have none for it: tells so on standard error and makes it 0, so that
// nothing is refused for its score. Returns what it told; empty: all is as the calibration has it.
// Throws model::WeightsError.
std::string HeedCoverage(const std::string& weights, const model::SceneKind& kind,
                         double* threshold);

// The calibration of such records for a promise. Its threshold is what the promise leads to;
// where nothing may be attempted by it, 1. `words` gets what is to be told.
model::Calibration CalibrationFrom(const model::CalibrationSample& sample,
                                   const model::Promise& promise, const std::string& command,
                                   std::vector<std::string>* words);

// No threshold of these weights keeps what was asked for, or they carry no calibration sample.
class PromiseError : public ExitError {
 public:
  explicit PromiseError(const std::string& what) : ExitError(kExitRefusal, what) {}
};

// The threshold that the sample stored with the weights gives for `promise` in scenes of this kind;
// tells why on Words() (tools/common/words.h), with the curve where not all of it can be kept.
// Throws PromiseError, model::WeightsError.
double PromisedThresholdOf(const std::string& weights, const model::Promise& promise,
                           const model::SceneKind& kind);

}  // namespace prospect::tools
