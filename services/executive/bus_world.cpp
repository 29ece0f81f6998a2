#include "services/executive/bus_world.h"

#include "services/executive/known_task.h"
#include "services/executive/person.h"
#include "services/executive/preparation.h"
#include "services/executive/task_view_messages.h"

namespace prospect::services {
namespace {

constexpr std::int64_t kVerdictMs = 150;  // for three messages: any may be lost

// Whoever carries actions out and says of one that it ended otherwise has given it up.
agent::ActionState StateOf(const action_status_t& status) {
  switch (status.state) {
    case action_status_t::STATE_SUCCEEDED:
      return agent::ActionState::kSucceeded;
    case action_status_t::STATE_FAILED:
      return agent::ActionState::kFailed;
    case action_status_t::STATE_REFUSED:
      return agent::ActionState::kRefused;
    default:
      return agent::ActionState::kCancelled;
  }
}

agent::TrialOutcome OutcomeOf(const action_status_t& status) {
  switch (status.outcome) {
    case label_t::OUTCOME_RUNNING:
      return agent::TrialOutcome::kRunning;
    case label_t::OUTCOME_SUCCESS:
      return agent::TrialOutcome::kSuccess;
    case label_t::OUTCOME_FAILURE:
      return agent::TrialOutcome::kFailure;
    default:
      return agent::TrialOutcome::kUnknown;
  }
}

agent::Glimpse GlimpseOf(const observation_t& observation) {
  return {PictureOf(observation), observation.frame,
          1e-6 * static_cast<double>(observation.sim_time_us)};
}

}  // namespace

BusWorld::BusWorld(Conversation& talk, const ExecutiveOptions& options)
    : talk_(talk), options_(options), actions_(talk) {
  if (options.ask) RequirePerson();
}

void BusWorld::Await() {
  talk_.health().SetState(health_t::STATE_BUSY);
  AwaitServices(talk_, options_);
  RequireWorld(talk_, options_);
  talk_.HoldWorld();
  if (options_.reset || !options_.explain_only) talk_.ClaimRobot();
  task_ = TaskViewOf(*talk_.view().task(), options_.task);
}

agent::Glimpse BusWorld::Begin() {
  PrepareScene(talk_, options_);
  const observation_t first = services::Look(talk_, 0);
  talk_.HoldTask();
  RequireAgreement(options_.task, *talk_.view().task(), talk_.bus().url());
  task_ = TaskViewOf(*talk_.view().task(), options_.task);
  return GlimpseOf(first);
}

std::int64_t BusWorld::seed() const {
  if (options_.reset) return options_.seed;
  const auto& label = talk_.view().label();
  return label ? label->seed : -1;
}

std::optional<agent::SceneLabel> BusWorld::label() const {
  const auto& label = talk_.view().label();
  if (!label) return std::nullopt;
  return SceneLabelOf(*label);
}

agent::ActionResult BusWorld::CarryOut(int action) {
  action_status_t status = actions_.CarryOut(action);
  frame_ = status.frame;
  if (status.state == action_status_t::STATE_ENDED) AskPerson(&status);
  return {StateOf(status), OutcomeOf(status), status.reason};
}

// The answer is said on the bus, too, so that recordings know it.
void BusWorld::AskPerson(action_status_t* status) {
  const std::string name = task_.ActionName(status->action);
  if (!options_.ask) {
    throw ExitError(kExitUsage,
                    "the robot cannot tell whether " + name + " worked: with --ask you are asked");
  }
  verdict_t verdict{};
  verdict.executive_id = talk_.id();
  verdict.command_id = status->command_id;
  verdict.episode_id = status->episode_id;
  verdict.action = status->action;
  verdict.succeeded = AskWhetherItWorked(talk_, name) ? 1 : 0;
  talk_.Until([] { return false; }, kVerdictMs, [&] { talk_.Say(verdict); }, kVerdictMs / 3);
  status->state =
      verdict.succeeded ? action_status_t::STATE_SUCCEEDED : action_status_t::STATE_FAILED;
}

agent::Glimpse BusWorld::Look() { return GlimpseOf(services::Look(talk_, frame_)); }

std::vector<agent::Picture> BusWorld::Frames() const {
  std::vector<agent::Picture> frames;
  for (const auto& [frame, picture] : talk_.view().frames()) frames.push_back(picture);
  return frames;
}

}  // namespace prospect::services
