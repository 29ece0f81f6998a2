#pragma once

#include <memory>
#include <string>
#include <vector>

#include "model/engine.h"
#include "model/recorded_trials.h"

namespace prospect::tools {

// Recorded trials, judged by weights that learned nothing from them.
struct Recorded {
  std::string weights;  // file
  model::RecordedTrials judged;
};

// What a search by this rule gives up.
model::GivenUpBelow GivenUpBy(const std::string& rule);

// Judges the trials of `data` that are held out, or all of them, by what searches by `rule` give
// up; shows progress. Throws model::DataError where there are none, or where `all` would take
// trials that the weights were trained on; model::WeightsError; ExitError after a stop signal.
Recorded JudgeData(const std::string& data, const std::string& weights, const std::string& rule,
                   bool all);

// Stores in the weights what these trials' first pictures look like to them. Returns a sentence
// about it; where there are too few, only that.
std::string StoreRecordedNovelty(const Recorded& recorded, const std::string& command);

}  // namespace prospect::tools
