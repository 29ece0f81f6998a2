#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "model/recorded_trials.h"
#include "model/refusal/sample.h"

namespace prospect::tools {

/// Of the table of --task NAME|FILE, in its order.
std::vector<std::string> ActionNames(const std::string& task);

/// How recorded plans fared, as a calibration keeps it. A plan that succeeded could be done; of a
/// scene whose plan failed nobody knows whether another would have worked, so it counts as
/// doubtful, never as hopeless. A plan that a search would have given up was not attempted.
model::CalibrationSample SampleOf(const model::RecordedTrials& judged);

/// Figures (docs/json.md): trials, succeeded, plan, reliability, f {one, ahead, actions}, pictures,
/// novelty. @param names of the actions, in the table's order; gauge: none where the weights have
/// none
nlohmann::json ReportOf(const model::RecordedTrials& judged, const std::vector<std::string>& names,
                        const std::optional<model::NoveltyGauge>& gauge);

/// The report for people: a table, what was not shown to be learned, and what more data would help
/// most.
std::string RecordedWords(const nlohmann::json& report);

}  // namespace prospect::tools
