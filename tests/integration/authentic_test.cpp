// Who may move the robot: with a key, nobody who does not have it, and nobody twice.

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <string>

#include "services/common/bus_key.h"
#include "tests/integration/support/commander.h"
#include "tests/integration/support/deployment.h"
#include "tests/unit/services/log_writer.h"

namespace prospect::tests {
namespace {

// The latest word of a service on messages that it refused of a channel.
std::int64_t Refused(const Witness& witness, const std::string& service,
                     const std::string& counter) {
  std::int64_t count = 0;
  for (const auto& health : witness.Services(service)) {
    for (const auto& one : health.counters)
      if (one.name.find(counter) != std::string::npos) count += one.value;
  }
  return count;
}

bool Moved(const Witness& witness) {
  for (const auto& status : witness.statuses)
    if (status.state != action_status_t::STATE_IDLE) return true;
  return false;
}

/// A stranger, who is on the bus and has no key; from then on everybody else has one.
class Authentic : public testing::Test {
 protected:
  Authentic() {
    const std::string path = MakeFolder("key") + "/key";
    std::ofstream(path) << std::string(64, '7') << "\n";
    std::system(("chmod 600 " + path).c_str());
    setenv("PROSPECT_KEY_FILE", path.c_str(), 1);
    services::SetProcessBusKey(services::ReadBusKey(path));
  }
  ~Authentic() override { unsetenv("PROSPECT_KEY_FILE"); }

  void ForgeCommands(const Witness& witness) {
    action_command_t start{};
    start.executive_id = 4711;
    start.command_id = ++forged_;
    start.episode_id = witness.episode_id;
    start.kind = action_command_t::KIND_START;
    stranger_.Publish(start);
    sim_command_t reset{};
    reset.sender_id = 4711;
    reset.command_id = forged_;
    reset.kind = sim_command_t::KIND_RESET;
    reset.present_episode_id = witness.episode_id;
    reset.seed = 99;
    reset.episode_id = 99;
    stranger_.Publish(reset);
  }

  // Evaluations by which every path is certain to succeed, for whoever asks.
  void ForgeReplies(const expand_request_t& request) {
    expand_reply_t reply{};
    reply.search_id = request.search_id;
    reply.epoch = request.epoch;
    reply.server_id = 4711;
    reply.weights_hash = request.weights_hash;
    reply.status = expand_reply_t::STATUS_OK;
    reply.client_ids = {request.client_id};
    reply.request_ids = {request.request_id};
    for (const path_t& path : request.paths) {
      evaluation_t evaluation{};
      evaluation.path = path;
      evaluation.value = evaluation.done = 1;
      reply.evaluations.push_back(evaluation);
    }
    messages::SetCounts(reply);
    stranger_.Publish(reply);
  }

  services::Bus stranger_;  // opened before there is a key
  std::int64_t forged_ = 0;
};

// A new scene in the place of the present one.
sim_command_t ResetOf(const Witness& witness) {
  sim_command_t reset{};
  reset.sender_id = 4711;
  reset.command_id = 1;
  reset.kind = sim_command_t::KIND_RESET;
  reset.present_episode_id = witness.episode_id;
  reset.seed = 99;
  reset.episode_id = 99;
  return reset;
}

TEST_F(Authentic, AStrangersCommandsMoveNothing) {
  Witness witness;
  Deployment deployment("authentic_commands");
  deployment.Simulator();
  ASSERT_TRUE(witness.Until(
      [&] { return witness.Ready("simulator", 1) && witness.episode_id >= 0; }, 10000));
  const std::int64_t episode = witness.episode_id;
  const auto refused = [&] {
    return Refused(witness, "simulator", "ACTION_COMMAND: not authentic") > 20 &&
           Refused(witness, "simulator", "SIM_COMMAND: not authentic") > 20;
  };
  EXPECT_TRUE(witness.Until(refused, 20000, [&] { ForgeCommands(witness); }));
  EXPECT_FALSE(Moved(witness));
  EXPECT_EQ(witness.episode_id, episode) << "no reset either";
}

// The same words with the key move it: the test above can fail.
TEST_F(Authentic, TheSameCommandWithTheKeyMoves) {
  Witness witness;
  Deployment deployment("authentic_control");
  deployment.Simulator();
  ASSERT_TRUE(witness.Until(
      [&] { return witness.Ready("simulator", 1) && witness.episode_id >= 0; }, 10000));
  Commander commander(witness);
  const auto start = commander.Start(1, 0);
  EXPECT_TRUE(witness.Until([&] { return Moved(witness); }, 10000,
                            [&] {
                              commander.Beat();
                              commander.Say(start);
                            }));
}

// A robot in another program, by examples/keyed.
TEST_F(Authentic, TheExampleRobotObeysTheKeyAlone) {
  Witness witness;
  Process robot("examples/example-robot", {"--bus", witness.bus.url()},
                MakeFolder("authentic_robot") + "/robot.log");
  ASSERT_TRUE(witness.Until([&] { return !witness.statuses.empty(); }, 10000));
  witness.episode_id = witness.statuses.back().episode_id;
  witness.Until([] { return false; }, 1000, [&] { ForgeCommands(witness); });
  EXPECT_FALSE(Moved(witness));
  Commander commander(witness);
  const auto start = commander.Start(1, 0);
  EXPECT_TRUE(witness.Until([&] { return Moved(witness); }, 10000,
                            [&] {
                              commander.Beat();
                              commander.Say(start);
                            }));
}

TEST_F(Authentic, AWholeEpisodeGoesOnBesideAForger) {
  Witness witness;
  Deployment deployment("authentic_episode");
  ASSERT_TRUE(deployment.Up(witness, 1));
  const auto subscription = witness.bus.Subscribe<expand_request_t>(
      [this](const expand_request_t& request) { ForgeReplies(request); });
  auto& executive = deployment.Executive();
  int code = -1;
  ASSERT_TRUE(witness.Until([&] { return (code = executive.Wait(0)) >= 0; }, 60000,
                            [&] { ForgeCommands(witness); }));
  EXPECT_TRUE(code == 0 || code == 4) << code;
  EXPECT_FALSE(deployment.Result().at("actions").empty());
  EXPECT_TRUE(witness.Until(
      [&] { return Refused(witness, "worker", "EXPAND_REPLY: not authentic") > 0; }, 5000));
  for (const auto& status : witness.statuses) EXPECT_NE(status.executive_id, 4711);
}

// Recorded from the bus and sent again, tags and all.
TEST_F(Authentic, RecordedCommandsMoveNothingAgain) {
  Witness witness;
  Deployment deployment("authentic_replay");
  deployment.Simulator();
  ASSERT_TRUE(witness.Until(
      [&] { return witness.Ready("simulator", 1) && witness.episode_id >= 0; }, 10000));
  std::vector<services::RawMessage> recorded;
  const auto subscription = stranger_.SubscribeAll([&](const services::RawMessage& message) {
    if (message.channel == "SIM_COMMAND") recorded.push_back(message);
  });
  const std::int64_t before = witness.episode_id;
  witness.bus.Publish(ResetOf(witness));
  ASSERT_TRUE(witness.Until(
      [&] {
        stranger_.Poll(0);
        return witness.episode_id != before && !recorded.empty();
      },
      10000));
  const std::int64_t episode = witness.episode_id;
  EXPECT_TRUE(
      witness.Until([&] { return Refused(witness, "simulator", "SIM_COMMAND: replayed") > 5; },
                    10000, [&] { stranger_.PublishRaw("SIM_COMMAND", recorded.front().bytes); }));
  EXPECT_EQ(witness.episode_id, episode);
}

// One that has just started has heard no sender yet, so the tag passes; but it is another's
// episode.
TEST_F(Authentic, ARecordedResetMovesNothingInASimulatorStartedAgain) {
  Witness witness;
  Deployment deployment("authentic_restart");
  std::vector<services::RawMessage> recorded;
  const auto subscription = stranger_.SubscribeAll([&](const services::RawMessage& message) {
    if (message.channel == "SIM_COMMAND") recorded.push_back(message);
  });
  const auto heard = [&] { return stranger_.Poll(0), witness.episode_id >= 0; };
  auto& first = deployment.Simulator();
  ASSERT_TRUE(witness.Until(heard, 10000));
  witness.bus.Publish(ResetOf(witness));
  ASSERT_TRUE(witness.Until(
      [&] { return stranger_.Poll(0), witness.episode_id == 99 && !recorded.empty(); }, 10000));
  first.Signal(SIGKILL);
  witness.episode_id = -1;
  deployment.Simulator();
  ASSERT_TRUE(
      witness.Until([&] { return witness.episode_id >= 0 && witness.episode_id != 99; }, 10000));
  const std::int64_t episode = witness.episode_id;
  stranger_.PublishRaw("SIM_COMMAND", recorded.front().bytes);
  EXPECT_TRUE(witness.Until(
      [&] { return Refused(witness, "simulator", "SIM_COMMAND: another episode") > 0; }, 5000));
  EXPECT_EQ(witness.episode_id, episode);
}

// A recording in which an action is started.
std::string MakeRecording(const Witness& witness, const std::string& folder) {
  const std::string path = folder + "/recording.lcmlog";
  services::LogWriter log(path);
  action_command_t start{};
  start.executive_id = 4711;
  start.command_id = 1;
  start.episode_id = witness.episode_id;
  start.kind = action_command_t::KIND_START;
  log.Write(start);
  search_stop_t stop{};
  stop.search_id = 12345;
  log.Write(stop);
  return path;
}

TEST(Playing, IsRefusedWhereADeploymentLives) {
  Witness witness;
  Deployment deployment("playing_refused");
  deployment.Simulator();
  ASSERT_TRUE(witness.Until(
      [&] { return witness.Ready("simulator", 1) && witness.episode_id >= 0; }, 10000));
  const std::string log = MakeRecording(witness, deployment.folder);
  Process play("prospect-bus", {"play", log, "--with-commands", "--bus", witness.bus.url()},
               deployment.folder + "/play.log");
  int code = -1;
  ASSERT_TRUE(witness.Until([&] { return (code = play.Wait(0)) >= 0; }, 20000));
  EXPECT_EQ(code, 12) << ReadText(deployment.folder + "/play.log");
  EXPECT_FALSE(Moved(witness));
  EXPECT_TRUE(witness.stops.empty());
}

// By default it is on another bus: what is up hears none of it.
TEST(Playing, HappensOnABusOfItsOwnWithoutCommands) {
  Witness witness;
  Deployment deployment("playing");
  deployment.Simulator();
  ASSERT_TRUE(witness.Until(
      [&] { return witness.Ready("simulator", 1) && witness.episode_id >= 0; }, 10000));
  const std::string log = MakeRecording(witness, deployment.folder);
  const auto play = [&](const std::vector<std::string>& more) {
    services::Bus there("udpm://239.255.76.67:7668?ttl=0");
    int commands = 0, stops = 0;
    const auto subscription =
        there.Subscribe<action_command_t>([&](const action_command_t&) { ++commands; });
    const auto second_subscription =
        there.Subscribe<search_stop_t>([&](const search_stop_t&) { ++stops; });
    std::vector<std::string> words{"play", log};
    words.insert(words.end(), more.begin(), more.end());
    Process player("prospect-bus", words, deployment.folder + "/play.log");
    int code = -1;
    EXPECT_TRUE(witness.Until(
        [&] {
          there.Poll(0);
          return code >= 0 ? stops > 0 : ((code = player.Wait(0)), false);
        },
        20000));
    EXPECT_EQ(code, 0) << ReadText(deployment.folder + "/play.log");
    return commands;
  };
  EXPECT_EQ(play({}), 0);
  EXPECT_EQ(play({"--with-commands"}), 1);
  EXPECT_FALSE(Moved(witness));
  EXPECT_TRUE(witness.stops.empty()) << "heard where it was not played";
}

}  // namespace
}  // namespace prospect::tests
