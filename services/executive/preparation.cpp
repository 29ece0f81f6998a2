#include "services/executive/preparation.h"

#include <spdlog/spdlog.h>

#include <algorithm>

#include "base/hash.h"
#include "base/number_format.h"
#include "cli/installation.h"
#include "services/common/ids.h"
#include "services/executive/known_task.h"

namespace prospect::services {
namespace {

constexpr std::int64_t kLookTimeoutMs = 5000;
constexpr int kSilentMs = 1500;                       // TASK and HEALTH come once a second
constexpr std::int64_t kCalibrationTimeoutMs = 5000;  // several times the servers' period

int Alive(Conversation& talk, const char* service) {
  return static_cast<int>(talk.monitor().Alive(service).size());
}

std::string Missing(Conversation& talk, const ExecutiveOptions& options) {
  std::string missing;
  if (!talk.view().task()) missing += " a simulator or robot (no TASK is published);";
  if (!options.AsksNetworks()) return missing;
  if (talk.view().servers().Live(0, SteadyMs()).empty())
    missing += " a model server (no MODEL_INFO);";
  const int workers = Alive(talk, "worker");
  if (workers < options.workers) {
    missing += " planner workers (" + std::to_string(workers) + " of " +
               std::to_string(options.workers) + " live);";
  }
  return missing;
}

sim_command_t ResetCommand(Conversation& talk, const ExecutiveOptions& options) {
  sim_command_t command{};
  command.present_episode_id = *talk.view().present_episode_id();
  command.sender_id = talk.id();
  command.command_id = talk.NextCommandId();
  command.kind = sim_command_t::KIND_RESET;
  command.seed = options.seed;
  command.episode_id = RandomId();
  command.objects = options.objects;
  command.legs = options.legs;
  return command;
}

// What is followed has the name that this very reset gave it. TASK, which has no such name, is
// known by its length. A robot says no LABEL.
bool SceneStands(Conversation& talk, const ExecutiveOptions& options) {
  const auto& view = talk.view();
  return view.latest() && view.status() && (view.label() || !view.LabelsExpected()) &&
         (options.legs == 0 || view.task()->plan_length == options.legs);
}

std::string Seconds(int milliseconds) { return base::Number("%g s", milliseconds / 1000.0); }

// Why no picture counts, and what to do.
std::string CameraAdvice(Conversation& talk) {
  const std::string defects = talk.view().PictureDefects();
  if (defects.empty()) return "is the camera running?";
  return "those that came were refused (" + defects + "): mend the camera's or TASK's size";
}

bool Fits(const model_info_t& info, const task_t& task) {
  return info.task == task.name && info.num_actions == task.num_actions &&
         info.image_width == task.image_width && info.image_height == task.image_height;
}

/// Weights without V, Q, p and f are said at once, not after waiting for workers.
void RequireJudgement(const model_info_t& info, const ExecutiveOptions& options) {
  if (!options.AsksNetworks() || options.workers == 0) return;
  if (info.judges) return;
  throw ExitError(kExitWeights, "weights " + base::HexText(info.weights_hash) + " for task '" +
                                    info.task +
                                    "' predict pictures only: they hold no V, Q, p and f to "
                                    "search with; ask " +
                                    cli::Typed("predict"));
}

void RequireJudgement(Conversation& talk, const ExecutiveOptions& options) {
  const auto& task = talk.view().task();
  for (const auto& info : talk.view().servers().Live(0, SteadyMs())) {
    if (task && Fits(info, *task)) RequireJudgement(info, options);
  }
}

// Before anything moves: a plan for one task must not be tried on another's robot. Once for each
// TASK that is heard.
void RequireTask(Conversation& talk, const ExecutiveOptions& options, std::int64_t* compared) {
  const auto& task = talk.view().task();
  if (!task || talk.view().task_hash() == *compared) return;
  RequireAgreement(options.task, *task, talk.bus().url());
  *compared = talk.view().task_hash();
}

}  // namespace

void AwaitServices(Conversation& talk, const ExecutiveOptions& options) {
  std::int64_t compared = 0;
  const auto complete = [&] {
    RequireTask(talk, options, &compared);
    RequireJudgement(talk, options);
    return Missing(talk, options).empty();
  };
  const int silent_ms = std::min(kSilentMs, options.services_timeout_ms);
  if (talk.Until(complete, silent_ms)) return;
  std::string missing = Missing(talk, options);
  while (!missing.empty() && missing.back() == ';') missing.pop_back();
  std::fprintf(stderr, "waiting for%s; at most %d s\n", missing.c_str(),
               (options.services_timeout_ms - silent_ms) / 1000);
  if (talk.Until(complete, options.services_timeout_ms - silent_ms)) return;
  throw ExitError(kExitServiceLost, "still missing on " + talk.bus().url() + ":" +
                                        Missing(talk, options) + " start them with " +
                                        cli::Typed("up") + ", a robot with --key \"$(" +
                                        cli::Typed("key") + ")\"");
}

void RequireWorld(Conversation& talk, const ExecutiveOptions& options) {
  const std::string& up = talk.view().task()->world_version;
  if (options.world.empty() || up == options.world) return;
  throw ExitError(kExitUsage, "another scene is up than was asked for (its world is '" + up +
                                  "', not '" + options.world + "'): leave --scene-file out, or " +
                                  cli::Typed("down") + " first");
}

void PrepareScene(Conversation& talk, const ExecutiveOptions& options) {
  if (!options.reset) {
    talk.view().FollowAny();
    if (talk.Until([&] { return talk.view().latest().has_value(); }, options.scene_timeout_ms))
      return;
    throw ExitError(kExitTimeout, "no OBSERVATION within " + Seconds(options.scene_timeout_ms) +
                                      ": " + CameraAdvice(talk));
  }
  const auto told = [&] { return talk.view().present_episode_id().has_value(); };
  if (!talk.Until(told, options.scene_timeout_ms))
    throw ExitError(kExitTimeout, "no ACTION_STATUS within " + Seconds(options.scene_timeout_ms) +
                                      ": is the simulator alive?");
  sim_command_t command = ResetCommand(talk, options);
  talk.view().Follow(command.episode_id);
  // Another may have put up a scene meanwhile, which the command must name to end it.
  const auto say = [&] {
    const std::int64_t present = *talk.view().present_episode_id();
    if (present != command.present_episode_id && present != command.episode_id) {
      command.present_episode_id = present;
      command.command_id = talk.NextCommandId();
    }
    talk.Say(command);
  };
  if (talk.Until([&] { return SceneStands(talk, options); }, options.scene_timeout_ms, say)) return;
  const std::string what = "scene " + std::to_string(options.seed) + " was not put up within " +
                           Seconds(options.scene_timeout_ms) + ": ";
  throw ExitError(kExitTimeout,
                  what + (talk.view().PictureDefects().empty()
                              ? "the simulator's log says why (objects or legs out of range?); "
                                "a robot that obeys no SIM_COMMAND needs --no-reset"
                              : CameraAdvice(talk)));
}

model_info_t ChooseModel(Conversation& talk, const ExecutiveOptions& options) {
  const auto live = talk.view().servers().Live(0, SteadyMs());
  if (live.empty())
    throw ExitError(kExitServiceLost,
                    "no model server is alive: start one with " + cli::Typed("up"));
  for (const auto& info : live) {
    const bool wanted =
        options.weights_hash.empty() || base::HexText(info.weights_hash) == options.weights_hash;
    if (!wanted || !Fits(info, *talk.view().task())) continue;
    RequireJudgement(info, options);
    return info;
  }
  const model_info_t& first = live.front();
  const std::string& task = talk.view().task()->name;
  const std::string remedy = first.engine == "scripted"
                                 ? "--weights scripted pretends to know the table of its --task: "
                                   "start it with --task for '" +
                                       task + "'"
                                 : "start one with --weights for task '" + task + "'";
  throw ExitError(kExitWeights, "no model server holds fitting weights: the first holds " +
                                    base::HexText(first.weights_hash) + " for task '" + first.task +
                                    "'; " + remedy);
}

std::vector<model::CalibrationSample> AwaitCalibrations(Conversation& talk,
                                                        const model_info_t& model, bool needed) {
  const auto heard = [&]() -> const auto& { return talk.view().calibrations(model.weights_hash); };
  const auto wanted = static_cast<std::size_t>(std::max(model.calibrations, needed ? 1 : 0));
  if (talk.Until([&] { return heard().size() >= wanted; }, kCalibrationTimeoutMs)) return heard();
  const std::string weights = "weights " + base::HexText(model.weights_hash);
  if (model.calibrations > 0) {
    throw ExitError(kExitWeights, weights + " were calibrated on " +
                                      std::to_string(model.calibrations) +
                                      " kinds of scenes, and CALIBRATION told of " +
                                      std::to_string(heard().size()) + " within 5 s");
  }
  throw ExitError(kExitWeights, weights +
                                    " carry no calibration sample, so nothing can be promised: "
                                    "make one with " +
                                    cli::Typed("evaluate calibrate"));
}

observation_t Look(Conversation& talk, std::int64_t frame) {
  const auto& latest = talk.view().latest();
  if (talk.Until([&] { return latest && latest->frame >= frame; }, kLookTimeoutMs)) return *latest;
  throw ExitError(kExitTimeout, "no picture of frame " + std::to_string(frame) +
                                    " within 5 s: " + CameraAdvice(talk));
}

}  // namespace prospect::services
