// Peers that say what does not fit: the executive ends with the right code and one line that names
// it.

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "services/common/clock.h"
#include "services/common/health.h"
#include "services/common/health_monitor.h"
#include "tests/integration/support/deployment.h"

namespace prospect::tests {
namespace {

constexpr int kTaskSide = 64;

void Resize(int side, observation_t* picture) {
  picture->width = picture->height = side;
  picture->data.assign(static_cast<std::size_t>(side) * static_cast<std::size_t>(side) * 3, 90);
}

/// A robot whose TASK says 64x64 and whose camera does as it likes. Every action succeeds at once.
class OddRobot {
 public:
  explicit OddRobot(Witness& witness) : witness_(witness), health_(witness.bus, "simulator") {
    health_.SetState(health_t::STATE_READY);
    status_.action = -1;
    status_.episode_id = kEpisode;
    status_.state = action_status_t::STATE_IDLE;
  }

  /// What it does to each picture, by the action's number (0 before the first).
  std::function<void(int, observation_t*)> spoil;
  /// How long an action takes it.
  std::int64_t action_ms = 0;
  /// What it does to each TASK, by the number of actions carried out.
  std::function<void(int, task_t*)> change_task;
  /// What it says of its scene, if anything, for how many actions.
  int labelled_actions = 0;
  /// From the first command on its HEALTH gets lost, and nothing else.
  bool health_gets_lost = false;

  // Every 20 ms through Witness::Until.
  void Tick() {
    if (!health_gets_lost || witness_.commands.empty()) health_.Tick();
    Obey();
    if (!due_.Due(services::SteadyMs())) return;
    SayTask();
    witness_.bus.Publish(status_);
    SayLabel();
    Look();
  }

 private:
  static constexpr std::int64_t kEpisode = 17;

  void Obey() {
    if (witness_.commands.empty()) return;
    const action_command_t& command = witness_.commands.back();
    const std::int64_t now_ms = services::SteadyMs();
    if (command.command_id != status_.command_id) {
      status_.executive_id = command.executive_id;
      status_.command_id = command.command_id;
      status_.action = command.action;
      status_.state = action_status_t::STATE_RUNNING;
      begun_ms_ = now_ms;
    }
    if (status_.state != action_status_t::STATE_RUNNING || now_ms - begun_ms_ < action_ms) return;
    status_.state = action_status_t::STATE_SUCCEEDED;
    ++status_.frame;
  }

  void SayTask() {
    task_t task{};
    task.name = "made";
    task.task_hash = 4711;
    for (int i = 0; i < 4; ++i) {
      action_t action{};
      action.index = i;
      action.name = "go(" + std::to_string(i) + ")";
      action.successors = {0, 1, 2, 3};
      task.actions.push_back(action);
    }
    task.initial = {0, 1, 2, 3};
    task.plan_length = 3;
    task.image_width = task.image_height = kTaskSide;
    task.tick_seconds = 0.1;
    task.action_time_limit = 10;
    if (change_task) change_task(static_cast<int>(status_.frame), &task);
    messages::SetCounts(task);
    witness_.bus.Publish(task);
  }

  void SayLabel() {
    if (labelled_actions == 0) return;
    label_t label{};
    label.episode_id = kEpisode;
    label.frame = status_.frame;
    label.seed = -1;
    label.action = label.previous_action = labelled_actions;
    label.segment = -1;
    label.present.assign(static_cast<std::size_t>(labelled_actions), 1);
    messages::SetCounts(label);
    witness_.bus.Publish(label);
  }

  void Look() {
    observation_t picture{};
    picture.episode_id = kEpisode;
    picture.frame = status_.frame;
    picture.encoding = observation_t::ENCODING_RGB8;
    Resize(kTaskSide, &picture);
    if (spoil) spoil(static_cast<int>(status_.frame), &picture);
    messages::SetCounts(picture);
    witness_.bus.Publish(picture);
  }

  Witness& witness_;
  services::HealthBeacon health_;
  services::Periodic due_{200};
  action_status_t status_{};
  std::int64_t begun_ms_ = 0;
};

int EndOf(Process& executive, Witness& witness, OddRobot& robot) {
  int code = -1;
  witness.Until([&] { return (code = executive.Wait(0)) >= 0; }, 30000, [&] { robot.Tick(); });
  return code;
}

// What the executive said last.
std::string ErrorLine(const std::string& log) {
  const std::size_t at = log.rfind("error: ");
  return at == std::string::npos ? log : log.substr(at);
}

void ExpectNamed(const std::string& log, const std::vector<std::string>& words) {
  const std::string line = ErrorLine(log);
  for (const auto& word : words)
    EXPECT_NE(line.find(word), std::string::npos) << word << ": " << log;
  EXPECT_EQ(std::count(line.begin(), line.end(), '\n'), 1) << line;
}

TEST(BadPeers, PicturesOfTheWrongSizeAreNamed) {
  Witness witness;
  Deployment deployment("wrong_size");
  OddRobot robot(witness);
  int pictures = 0;
  robot.spoil = [&](int, observation_t* picture) {
    if (++pictures % 2 == 0) Resize(32, picture);
    if (pictures % 2 == 1) picture->data.resize(100);
  };
  auto& executive = deployment.Executive({"--no-reset", "--policy", "plan:0,1,2"});
  EXPECT_EQ(EndOf(executive, witness, robot), 16);
  ExpectNamed(deployment.Log("1-prospect-executive"),
              {"OBSERVATION", "32x32", "64x64", "wrong picture size", "mend"});
  EXPECT_TRUE(witness.commands.empty()) << "nothing may be done blindly";
}

TEST(BadPeers, ACameraThatChangesItsSizeIsNamed) {
  Witness witness;
  Deployment deployment("changed_size");
  OddRobot robot(witness);
  robot.spoil = [](int actions, observation_t* picture) {
    if (actions > 0) Resize(48, picture);
  };
  auto& executive = deployment.Executive({"--no-reset", "--policy", "plan:0,1,2"});
  EXPECT_EQ(EndOf(executive, witness, robot), 16);
  ExpectNamed(deployment.Log("1-prospect-executive"), {"no picture of frame 1", "48x48", "64x64"});
  EXPECT_EQ(deployment.Result().at("outcome"), "stopped");
  EXPECT_EQ(deployment.Result().at("exit_code"), 16);
  const auto starts = std::count_if(witness.commands.begin(), witness.commands.end(),
                                    [](const auto& command) { return command.action > 0; });
  EXPECT_EQ(starts, 0) << "no further action without a picture";
}

TEST(BadPeers, LossOfHealthAloneDoesNotEndAnEpisode) {
  Witness witness;
  Deployment deployment("lost_health");
  OddRobot robot(witness);
  robot.health_gets_lost = true;
  robot.action_ms = services::HealthMonitor::kDeadMs + 1000;
  auto& executive = deployment.Executive({"--no-reset", "--policy", "plan:0,1"});
  EXPECT_NE(EndOf(executive, witness, robot), 15) << deployment.Log("1-prospect-executive");
  std::set<int> done;
  for (const auto& command : witness.commands) {
    if (command.kind == action_command_t::KIND_START) done.insert(command.action);
  }
  EXPECT_EQ(done, (std::set<int>{0, 1}));
}

TEST(BadPeers, WeightsOfAnotherTaskAreNamed) {
  Witness witness;
  Deployment deployment("other_weights");
  deployment.Simulator();
  deployment.Worker();
  Process server("prospect-model-server", {"--weights", "scripted-tree"},
                 deployment.folder + "/server.log");
  auto& executive = deployment.Executive();
  int code = -1;
  ASSERT_TRUE(witness.Until([&] { return (code = executive.Wait(0)) >= 0; }, 30000));
  EXPECT_EQ(code, 10);
  ExpectNamed(deployment.Log("3-prospect-executive"),
              {"weights", "'scripted-tree'", "--weights", "'navigation'"});
  EXPECT_TRUE(witness.commands.empty());
}

int EndOf(Process& executive, Witness& witness) {
  int code = -1;
  witness.Until([&] { return (code = executive.Wait(0)) >= 0; }, 60000);
  return code;
}

void ExpectRefused(const Deployment& deployment, const Witness& witness, const std::string& why) {
  EXPECT_EQ(deployment.Result().at("outcome"), "refused");
  const std::string reason = deployment.Result().at("reason");
  EXPECT_NE(reason.find(why), std::string::npos) << reason;
  EXPECT_NE(reason.find("--novelty 0 does without"), std::string::npos) << reason;
  EXPECT_TRUE(witness.commands.empty());
  ASSERT_FALSE(witness.plans.empty());
  EXPECT_EQ(witness.plans.back().decision, plan_t::DECISION_REFUSE);
}

// A safeguard that cannot be asked does not pass.
TEST(BadPeers, WhereNobodyKnowsThePictureNothingIsDone) {
  Witness witness;
  Deployment deployment("unasked_novelty");
  ASSERT_TRUE(deployment.Up(witness, 1));
  const std::vector<std::string> deaf{"--chaos", "drop=1,channel=PREDICT_REPLY"};
  EXPECT_EQ(EndOf(deployment.Executive(deaf), witness), 3);
  ExpectRefused(deployment, witness, "no server answered within 3 s");

  const int code = EndOf(
      deployment.Executive({"--novelty", "0", "--chaos", "drop=1,channel=PREDICT_REPLY"}), witness);
  EXPECT_TRUE(code == 0 || code == 4) << code;
  EXPECT_FALSE(witness.commands.empty());
}

TEST(BadPeers, AnImpossibleWordOnThePictureIsARefusal) {
  Witness witness;
  Deployment deployment("impossible_novelty");
  deployment.Simulator();
  deployment.ModelServer({"--chaos", "drop=1,channel=PREDICT_REQUEST"});
  deployment.Worker();
  const auto subscription =
      witness.bus.Subscribe<predict_request_t>([&](const predict_request_t& request) {
        predict_reply_t reply{};
        reply.client_id = request.client_id;
        reply.request_id = request.request_id;
        reply.search_id = request.search_id;
        reply.path = request.path;
        reply.status = expand_reply_t::STATUS_OK;
        reply.num_novelty = 1;
        reply.novelty.resize(1);
        reply.novelty[0].p = 2;
        witness.bus.Publish(reply);
      });
  EXPECT_EQ(EndOf(deployment.Executive(), witness), 3);
  ExpectRefused(deployment, witness, "no server answered within 3 s");
}

TEST(BadPeers, ATaskThatChangesInMidEpisodeIsNamed) {
  Witness witness;
  Deployment deployment("changed_task");
  OddRobot robot(witness);
  robot.change_task = [](int actions, task_t* task) {
    if (actions > 0) task->plan_length = 2;
  };
  auto& executive = deployment.Executive({"--no-reset", "--policy", "plan:0,1,2"});
  EXPECT_EQ(EndOf(executive, witness, robot), 15);
  ExpectNamed(deployment.Log("1-prospect-executive"), {"TASK has changed"});
  EXPECT_EQ(deployment.Result().at("exit_code"), 15);
}

// Whatever ends an episode, result.json tells of it and the exit code is a documented one.
TEST(BadPeers, WhatFitsNothingStillLeavesItsFiles) {
  Witness witness;
  Deployment deployment("odd_labels");
  OddRobot robot(witness);
  robot.labelled_actions = 2;
  auto& executive = deployment.Executive({"--no-reset", "--policy", "collect"});
  EXPECT_EQ(EndOf(executive, witness, robot), 4);
  ExpectNamed(deployment.Log("1-prospect-executive"), {"LABEL tells of 2 actions, TASK of 4"});
  EXPECT_EQ(deployment.Result().at("outcome"), "stopped");
  EXPECT_EQ(deployment.Result().at("exit_code"), 4);
}

}  // namespace
}  // namespace prospect::tests
