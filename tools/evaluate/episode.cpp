#include "tools/evaluate/episode.h"

#include <stdexcept>

#include "agent/episode.h"

namespace prospect::tools {
namespace {

using planner::NextStep;

Ending EndingFrom(const std::string& outcome) {
  if (outcome == "solved") return Ending::kSolved;
  if (outcome == "refused") return Ending::kRefused;
  if (outcome == "stopped") return Ending::kStopped;
  if (outcome == "failed") return Ending::kFailed;
  throw std::logic_error("an episode ended as '" + outcome + "'");
}

// By the world, which the agent does not know.
void Judge(const sim::Task& task, const Goal& goal, EpisodeRecord* measured) {
  const sim::Progress progress = task.progress();
  if (progress.outcome == sim::Outcome::kFailure) measured->reason = progress.reason;
  if (progress.outcome != sim::Outcome::kSuccess) return;
  const bool holds = planner::Holds(goal, task.Facts());
  measured->ending = holds ? Ending::kSolved : Ending::kFailed;
  measured->reason = holds ? "" : "goal not reached";
}

}  // namespace

EpisodeRecord MeasuredOf(const agent::EpisodeRecord& record) {
  EpisodeRecord measured;
  measured.ending = EndingFrom(record.outcome);
  measured.reason = record.reason;
  measured.evaluations = record.evaluations;
  measured.rollouts = record.rollouts;
  for (const agent::ActRecord& act : record.acts) measured.actions.push_back(act.action);
  for (const agent::SearchRecord& search : record.searches) {
    measured.seconds_per_plan.push_back(search.decision_seconds);
    measured.scores.push_back(search.score);
    measured.surprises.push_back(search.surprise);
    measured.begun_anew += search.kind == NextStep::Kind::kAnew;
    measured.carried_on += search.kind == NextStep::Kind::kCarryOn;
  }
  if (!measured.scores.empty()) measured.first_score = measured.scores.front();
  return measured;
}

nlohmann::json ToJson(const EpisodeRecord& record) {
  return {{"ending", ToString(record.ending)}, {"reason", record.reason},
          {"actions", record.actions},         {"score", record.first_score},
          {"scores", record.scores},           {"surprises", record.surprises},
          {"begun_anew", record.begun_anew},   {"carried_on", record.carried_on},
          {"evaluations", record.evaluations}, {"rollouts", record.rollouts},
          {"seconds", record.seconds_per_plan}};
}

const char* ToString(Ending ending) {
  switch (ending) {
    case Ending::kSolved:
      return "solved";
    case Ending::kRefused:
      return "refused";
    case Ending::kStopped:
      return "stopped";
    case Ending::kFailed:
      return "failed";
  }
  return "unknown";
}

EpisodeRecord RunEpisode(sim::Task& task, Decider& decider, std::uint64_t seed, double image_noise,
                         const Goal& goal, const AfterAction& after, agent::Listener* listener) {
  agent::Listener nobody;
  SimulatedWorld world(task, seed, image_noise, after);
  decider.mind->Enter(task, seed);
  agent::Episode episode(world, decider.mind.get(), decider.options,
                         listener != nullptr ? *listener : nobody);
  EpisodeRecord measured = MeasuredOf(episode.Run());
  Judge(task, goal, &measured);
  return measured;
}

EpisodeRecord RunGivenPlan(sim::Task& task, const std::vector<int>& plan, std::uint64_t seed) {
  agent::Listener nobody;
  SimulatedWorld world(task, seed, 0);
  agent::EpisodeOptions options;
  options.policy = "plan";
  options.plan = [&plan] { return plan; };
  EpisodeRecord measured = MeasuredOf(agent::Episode(world, nullptr, options, nobody).Run());
  Judge(task, {}, &measured);
  return measured;
}

}  // namespace prospect::tools
