#pragma once

#include <map>
#include <set>
#include <vector>

#include "agent/picture.h"
#include "agent/record.h"
#include "agent/task_view.h"
#include "planner/plan.h"

namespace prospect::agent {

// What the record of a search shows of the plan and of what was not chosen. Pure functions.

/// One for each first action that was not chosen: the best future through it, or the one that came
/// furthest.
std::vector<planner::Future> OtherFirstActions(const planner::Plan& plan);

/// The states whose pictures show the plan, step by step, and what was not chosen.
std::set<planner::Path> StatesOf(const planner::Plan& plan);

/// The plan's steps, without pictures.
std::vector<StepRecord> StepsOf(const planner::Plan& plan, const TaskView& task);

/// Puts pictures into the steps of the plan, and tells what was not chosen.
void Illustrate(const planner::Plan& plan, const TaskView& task,
                std::map<planner::Path, Picture> pictures, SearchRecord* record);

/// The steps' states, in order.
std::vector<planner::Path> StatesOf(const std::vector<StepRecord>& steps);
void SetPictures(std::map<planner::Path, Picture> pictures, std::vector<StepRecord>* steps);

}  // namespace prospect::agent
