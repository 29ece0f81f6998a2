#include "services/executive/trial_loop.h"

#include <filesystem>
#include <iostream>

#include "services/executive/between_trials.h"
#include "services/executive/person.h"
#include "services/executive/preparation.h"

namespace prospect::services {
namespace {

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
    if (call.pause) AwaitEnter(talk, "Trial " + std::to_string(counts.episodes() + 1));
    if (!call.options.reset) AwaitNewEpisode(talk, last, call.options);
    ExecutiveOptions options = call.options;
    options.seed += counts.episodes();
    options.out.clear();  // no files of a single trial
    counts.Add(RunSilently(talk, options));
    counts.Write();
    last = talk.view().episode_id();
    if (due.Due(SteadyMs())) Tell(call, counts);
  }
  Tell(call, counts);
  return counts;
}

}  // namespace prospect::services
