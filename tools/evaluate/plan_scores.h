#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "model/engine.h"
#include "sim/task.h"
#include "tools/evaluate/plan_outcomes.h"

namespace prospect::tools {

// What the networks expect of each plan, beside what came of it:
//   {seed, plans: [{plan, frequency, again, score: [by depth], value: [...], done: [...]}],
//    pictures: [{depth, error, copy}]}
// score[k]: V after k + 1 actions times f of all of them, as the planner ranks. pictures: the mean
// absolute error (0 to 1, clean pictures) of each imagined state that really came about in the
// trial's own run, and that of the first picture in its place.
using PlanScene = nlohmann::json;

PlanScene ScorePlans(sim::Task& task, model::Engine& engine, std::uint64_t scene_seed,
                     double image_noise, const std::vector<PlanOutcome>& outcomes, int runs);

// The figures over scenes: `ranking` (all plans complete) and `by_depth`, each with
//   rho      mean over scenes with spread of Spearman's rank correlation of score and frequency
//   auroc    area under the ROC curve of score against "frequency at least a half", all plans
// and their 95 % intervals by bootstrap over scenes; the same with the frequency of other runs in
// the score's place (`ceiling`).
nlohmann::json SummarisePlans(const std::vector<PlanScene>& scenes);

// The summary as a table for a person.
std::string PlanTable(const nlohmann::json& summary);

// Spearman's rank correlation, equal values sharing their mean rank; NaN without spread in x or y.
double RankCorrelation(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace prospect::tools
