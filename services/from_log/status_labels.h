#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "lcmtypes/messages.h"

namespace prospect::services {

/// What LABEL would have said of each frame of an episode, from what a robot says of its actions.
/// The picture on which an action ended is the first of the next one (model/trial.h): what is seen
/// when it is decided on, before anything moves. The trial ends with the first action that failed,
/// where the robot judges it, or, where it judges nothing, with the last action of a plan. There is
/// no seed, and all actions of the table may be done.
/// @param statuses of one episode, in the order in which they were heard, repeats included
/// @param verdicts of persons, on actions of which the robot said that they ended and no more
/// @param last_frame of the pictures that were heard
/// @return labels by frame, up to the trial's end or as far as actions ended
/// Throws RunError where an action was cancelled, its end was not heard, nobody said whether it
/// succeeded, or it has no pictures.
std::map<std::int64_t, label_t> LabelsFrom(const std::vector<action_status_t>& statuses,
                                           const std::vector<verdict_t>& verdicts,
                                           const task_t& task, std::int64_t last_frame);

}  // namespace prospect::services
