#include "tools/evaluate/episode.h"

#include <chrono>
#include <cmath>

#include "base/sensor_noise.h"
#include "sim/rollout.h"

namespace prospect::tools {
namespace {

// What the camera's user sees: frame numbers count ticks, as on the bus and in data sets.
std::vector<std::uint8_t> Look(sim::Task& task, std::uint64_t seed, double image_noise) {
  std::vector<std::uint8_t> pixels = task.Observe().rgb;
  const auto frame =
      static_cast<std::int64_t>(std::llround(task.progress().time / task.spec().tick_seconds));
  base::AddSensorNoise(pixels.data(), pixels.size(), seed, frame, image_noise);
  return pixels;
}

double SecondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

Ending EndingOf(const sim::Progress& progress, const EpisodeRecord& record) {
  if (progress.outcome == sim::Outcome::kSuccess) return Ending::kSolved;
  if (progress.outcome == sim::Outcome::kFailure) return Ending::kFailed;
  return record.actions.empty() ? Ending::kRefused : Ending::kStopped;
}

}  // namespace

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
                         const Goal& goal, const AfterAction& after) {
  task.Reset(seed);
  EpisodeRecord record;
  planner::Path executed;
  std::vector<std::uint8_t> latest = Look(task, seed, image_noise);
  decider.Begin(seed, latest);
  while (task.progress().outcome == sim::Outcome::kRunning) {
    const auto start = std::chrono::steady_clock::now();
    const Decision decision = decider.Decide(executed, latest, task);
    record.seconds_per_plan.push_back(SecondsSince(start));
    if (executed.empty()) record.first_score = decision.score;
    record.evaluations += decision.evaluations;
    record.rollouts += decision.rollouts;
    record.reason = decision.reason;
    record.scores.push_back(decision.score);
    record.surprises.push_back(decision.surprise);
    record.begun_anew += decision.anew;
    record.carried_on += decision.carried_on;
    if (decision.action < 0) break;
    record.actions.push_back(decision.action);
    if (!sim::RunAction(task, decision.action, nullptr)) {
      record.ending = Ending::kFailed;
      record.reason = "illegal action";
      return record;
    }
    executed.push_back(static_cast<std::uint8_t>(decision.action));
    latest = Look(task, seed, image_noise);
    if (after && task.progress().outcome == sim::Outcome::kRunning) after(task);
  }
  const sim::Progress progress = task.progress();
  record.ending = EndingOf(progress, record);
  if (record.ending == Ending::kFailed) record.reason = progress.reason;
  if (record.ending == Ending::kSolved) record.reason.clear();
  if (record.ending == Ending::kSolved && !planner::Holds(goal, task.Facts())) {
    record.ending = Ending::kFailed;
    record.reason = "goal not reached";
  }
  return record;
}

}  // namespace prospect::tools
