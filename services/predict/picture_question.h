#pragma once

#include <map>
#include <vector>

#include "lcmtypes/messages.h"
#include "planner/path.h"
#include "services/executive/conversation.h"
#include "services/executive/predictions.h"

namespace prospect::services {

/// From what and for what pictures are wanted.
struct PictureQuestion {
  observation_t first, present;  ///< x0, and x
  planner::Path executed;        ///< what was done before x, as far as the task's rules need it
  std::vector<planner::Path> paths;
};

/// Asks a model server what the world would look like after each path: announces the root
/// (SEARCH_ROOT, with no time to search, so that workers leave it alone), hands the pictures out
/// (SEARCH_IMAGE), asks (PREDICT_REQUEST), and ends it (SEARCH_STOP). Pictures that do not come are
/// missing from the answer. Throws ExitError: kExitServiceLost when no server takes the pictures
/// within 10 s, and as Conversation::Turn does.
std::map<planner::Path, agent::Picture> AskForPictures(Conversation& talk, PredictionInbox* inbox,
                                                       const model_info_t& server,
                                                       const PictureQuestion& question);

}  // namespace prospect::services
