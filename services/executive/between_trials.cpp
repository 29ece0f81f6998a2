#include "services/executive/between_trials.h"

#include <string>

#include "base/exit_error.h"
#include "services/executive/bus_episode.h"

namespace prospect::services {

void AwaitNewEpisode(Conversation& talk, std::int64_t last, const ExecutiveOptions& options) {
  const BusView& view = talk.view();
  const auto begun = [&] {
    return view.present_episode_id() && *view.present_episode_id() != last;
  };
  if (talk.Until(begun, options.scene_timeout_ms)) return;
  throw ExitError(kExitTimeout, "the robot still says episode " + std::to_string(last) +
                                    ": it must begin a new one for each trial");
}

agent::EpisodeRecord RunSilently(Conversation& talk, const ExecutiveOptions& options) {
  BusEpisode episode(talk, options, [](const std::string&) {});
  try {
    return episode.Run();
  } catch (const std::exception& error) {
    episode.Stopped(error.what());  // and lets go of the robot
    throw;
  }
}

}  // namespace prospect::services
