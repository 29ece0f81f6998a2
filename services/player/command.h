#pragma once

#include <string>

#include "cli/fwd.h"
#include "services/common/common_options.h"
#include "services/player/video_scene.h"

namespace prospect::services {

/// A video in a simulator's place on the bus. For the supervisor; people say `prospect up --video`.
struct PlayVideoOptions {
  CommonOptions bus;
  VideoChoice choice;
  double speed = 1;   ///< 1: as it was filmed
  bool loop = false;  ///< begin again after the end, as the next episode
};
void Define(CLI::App& app, PlayVideoOptions& options);

/// @return the exit code. @throws ExitError
int RunPlayVideo(const PlayVideoOptions& options);

}  // namespace prospect::services
