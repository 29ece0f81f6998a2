#include "services/executive/between_trials.h"

#include <poll.h>
#include <unistd.h>

#include <iostream>

#include "base/exit_error.h"
#include "services/executive/bus_episode.h"

namespace prospect::services {
namespace {

constexpr std::int64_t kForeverMs = INT64_C(1) << 40;

bool EnterTyped() {
  pollfd input{STDIN_FILENO, POLLIN, 0};
  return poll(&input, 1, 0) > 0;
}

}  // namespace

void AwaitEnter(Conversation& talk, const std::string& what) {
  std::cerr << what << ": set the scene up, then type Enter" << std::endl;
  talk.Until(EnterTyped, kForeverMs);
  for (char letter = 0; letter != '\n';) {
    if (read(STDIN_FILENO, &letter, 1) != 1)
      throw ExitError(kExitInterrupted, "nobody can type Enter: the input has ended");
  }
}

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
