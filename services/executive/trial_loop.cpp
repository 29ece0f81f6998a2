#include "services/executive/trial_loop.h"

#include <poll.h>
#include <unistd.h>

#include <filesystem>
#include <iostream>

#include "base/exit_error.h"
#include "services/executive/bus_episode.h"
#include "services/executive/preparation.h"

namespace prospect::services {
namespace {

constexpr std::int64_t kForeverMs = INT64_C(1) << 40;

bool EnterTyped() {
  pollfd input{STDIN_FILENO, POLLIN, 0};
  return poll(&input, 1, 0) > 0;
}

// Goes on listening and saying that it lives.
void AwaitEnter(Conversation& talk, std::int64_t number) {
  std::cerr << "Trial " << number << ": set the scene up, then type Enter" << std::endl;
  talk.Until(EnterTyped, kForeverMs);
  for (char letter = 0; letter != '\n';) {
    if (read(STDIN_FILENO, &letter, 1) != 1)
      throw ExitError(kExitInterrupted, "nobody can type Enter: the input has ended");
  }
}

// Of a robot that is not told to begin one: what the last trial left is no new scene.
void AwaitNewEpisode(Conversation& talk, std::int64_t last, const ExecutiveOptions& options) {
  const BusView& view = talk.view();
  const auto begun = [&] {
    return view.present_episode_id() && *view.present_episode_id() != last;
  };
  if (talk.Until(begun, options.scene_timeout_ms)) return;
  throw ExitError(kExitTimeout, "the robot still says episode " + std::to_string(last) +
                                    ": it must begin a new one for each trial");
}

agent::EpisodeRecord RunTrial(Conversation& talk, const ExecutiveOptions& options) {
  BusEpisode episode(talk, options, [](const std::string&) {});
  try {
    return episode.Run();
  } catch (const std::exception& error) {
    episode.Stopped(error.what());  // and lets go of the robot
    throw;
  }
}

void Tell(const ExecutiveCall& call, const TrialCounts& counts) {
  if (!call.report.talks()) return;
  std::cout << counts.episodes() << " of " << call.episodes << " trials, " << counts.solved()
            << " solved" << std::endl;
}

}  // namespace

TrialCounts RunTrials(Conversation& talk, const ExecutiveCall& call) {
  AwaitServices(talk, call.options);  // whose table is counted
  std::filesystem::create_directories(call.options.out);
  TrialCounts counts(call.options.out + "/trials.json", *talk.view().task(), call.options.seed);
  Periodic due(1000);
  std::int64_t last = -1;
  while (counts.episodes() < call.episodes) {
    if (call.pause) AwaitEnter(talk, counts.episodes() + 1);
    if (!call.options.reset) AwaitNewEpisode(talk, last, call.options);
    ExecutiveOptions options = call.options;
    options.seed += counts.episodes();
    options.out.clear();  // no files of a single trial
    counts.Add(RunTrial(talk, options));
    counts.Write();
    last = talk.view().episode_id();
    if (due.Due(SteadyMs())) Tell(call, counts);
  }
  Tell(call, counts);
  return counts;
}

}  // namespace prospect::services
