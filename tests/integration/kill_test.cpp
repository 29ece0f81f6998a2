// SIGKILL of each kind of process, in the middle of a search and of an action: what happens then,
// within ten seconds, and that no action is carried out twice.
//
//                 in a search                               in an action
//   worker        started again, joins the same search      the action goes on, the next search,
//   too model server  started again, takes the same search up   the action goes on, the next
//   search, too simulator     the executive ends with 15, nothing sent   the executive ends with 15
//   executive     workers and servers are free again         the robot stops
//
// Without a supervisor a search whose only worker or server was killed ends with 15.

#include <gtest/gtest.h>
#include <signal.h>

#include <map>
#include <set>
#include <string>
#include <utility>

#include "services/common/clock.h"
#include "tests/integration/support/deployment.h"
#include "tests/integration/support/supervised.h"

namespace prospect::tests {
namespace {

using services::SteadyMs;

constexpr int kStatedMs = 10000;
// A scene in which the first action that the scripted engine chooses succeeds.
constexpr int kSeed = 1500005;

bool HasAnswer(const expand_reply_t& reply) { return !reply.evaluations.empty(); }

// The latest search has evaluations, and nobody has ended it.
bool Searching(const Witness& witness) {
  if (witness.roots.empty()) return false;
  const std::int64_t id = witness.roots.back().search_id;
  for (const auto& stop : witness.stops) {
    if (stop.search_id == id) return false;
  }
  for (const auto& reply : witness.replies) {
    if (reply.search_id == id && HasAnswer(reply)) return true;
  }
  return false;
}

bool Acting(const Witness& witness) {
  return !witness.statuses.empty() &&
         witness.statuses.back().state == action_status_t::STATE_RUNNING &&
         !witness.labels.empty() && witness.labels.rbegin()->second.frame >= 3;
}

using CommandName = std::pair<std::int64_t, std::int64_t>;  // executive, command

// Each command was begun at most once, and no executive asked for one action under two ids: in this
// task no action of an episode repeats.
void ExpectNothingTwice(const Witness& witness) {
  std::map<CommandName, int> begun;
  action_status_t before{};
  for (const auto& status : witness.statuses) {
    const bool same = status.executive_id == before.executive_id &&
                      status.command_id == before.command_id && before.state == status.state;
    if (status.state == action_status_t::STATE_RUNNING && !same)
      ++begun[{status.executive_id, status.command_id}];
    before = status;
  }
  for (const auto& [name, times] : begun) EXPECT_EQ(times, 1) << "command " << name.second;

  std::map<CommandName, int> actions;
  for (const auto& command : witness.commands) {
    if (command.kind == action_command_t::KIND_START)
      actions[{command.executive_id, command.command_id}] = command.action;
  }
  std::set<std::pair<std::int64_t, int>> asked;
  for (const auto& [name, action] : actions)
    EXPECT_TRUE(asked.insert({name.first, action}).second) << "action " << action;
}

/// What an executive of these tests comes to.
struct Ending {
  int code = -1;
  std::int64_t took_ms = 0;  // since Await() was called
  std::string log;
};

class Executives {
 public:
  Executives(Witness& witness, std::string folder)
      : witness_(witness), folder_(std::move(folder)) {}

  Process Start(const std::vector<std::string>& more) {
    out_ = folder_ + "/out-" + std::to_string(++started_);
    std::vector<std::string> arguments{"--seed", std::to_string(kSeed), "--out", out_};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return Process("prospect-executive", arguments, out_ + ".log");
  }

  Ending Await(Process& executive, int timeout_ms) {
    Ending ending;
    const std::int64_t since_ms = SteadyMs();
    witness_.Until([&] { return (ending.code = executive.Wait(0)) >= 0; }, timeout_ms);
    ending.took_ms = SteadyMs() - since_ms;
    ending.log = ReadText(out_ + ".log");
    return ending;
  }

  nlohmann::json Result() const {
    return nlohmann::json::parse(ReadText(out_ + "/result.json"), nullptr, false);
  }

 private:
  Witness& witness_;
  std::string folder_, out_;
  int started_ = 0;
};

bool IsVerdict(int code) { return code == 0 || code == 3 || code == 4; }

void ExpectServiceLost(const Ending& ending, const std::string& named) {
  EXPECT_EQ(ending.code, 15) << ending.log;
  EXPECT_LT(ending.took_ms, kStatedMs);
  EXPECT_NE(ending.log.find(named), std::string::npos) << ending.log;
}

class Killed : public testing::Test, protected Supervised {
 protected:
  Killed()
      : Supervised(std::string("killed_") +
                   testing::UnitTest::GetInstance()->current_test_info()->name()),
        executives(witness, folder) {}

  // Evaluations that take their time make a search last; few frames a second make an action last.
  Process Up(const char* frames_per_second) {
    Options options;
    options.workers = 1;
    options.chaos = "delay=60ms,seed=1,channel=EXPAND_.*";
    options.simulator = {"--frames-per-second", frames_per_second};
    return Supervised::Start(options);
  }

  Process Executive(const std::string& policy) {
    return executives.Start({"--policy", policy, "--samples", "30", "--budget-ms", "8000"});
  }

  int Kill(const std::string& name) {
    const int pid = PidOf(name);
    EXPECT_GT(pid, 0);
    if (pid > 0) kill(pid, SIGKILL);
    return pid;
  }

  // A new deployment of the killed process serves the next episode.
  void ExpectTheNextEpisodeWorks(const std::vector<std::string>& more, int code) {
    Process executive = executives.Start(more);
    const Ending ending = executives.Await(executive, 30000);
    EXPECT_EQ(ending.code, code) << ending.log;
  }

  Executives executives;
};

TEST_F(Killed, WorkerInASearchComesBackToIt) {
  Process supervisor = Up("200");
  ASSERT_TRUE(AllReady(1));
  Process executive = Executive("search");
  ASSERT_TRUE(witness.Until([&] { return Searching(witness); }, 15000));
  const std::int64_t search = witness.roots.back().search_id;
  const int dead = Kill("worker-1");
  const std::size_t before = witness.replies.size();
  EXPECT_TRUE(BackWithin("worker-1", dead, kStatedMs));
  // With the only worker dead, evaluations go on only if its successor asks for them.
  const auto goes_on = [&] {
    return witness.replies.size() > before + 4 && witness.replies.back().search_id == search;
  };
  EXPECT_TRUE(witness.Until(goes_on, kStatedMs));
  const Ending ending = executives.Await(executive, 40000);
  EXPECT_TRUE(IsVerdict(ending.code)) << ending.code << ending.log;
  ExpectNothingTwice(witness);
}

TEST_F(Killed, ModelServerInASearchTakesItUpAgain) {
  Process supervisor = Up("200");
  ASSERT_TRUE(AllReady(1));
  Process executive = Executive("search");
  ASSERT_TRUE(witness.Until([&] { return Searching(witness); }, 15000));
  const std::int64_t search = witness.roots.back().search_id;
  const std::int64_t old_server = witness.replies.back().server_id;
  const int dead = Kill("model");
  EXPECT_TRUE(BackWithin("model", dead, kStatedMs));
  const auto answered_anew = [&] {
    const auto& reply = witness.replies.back();
    return reply.server_id != old_server && HasAnswer(reply) && reply.search_id == search;
  };
  EXPECT_TRUE(witness.Until(answered_anew, kStatedMs));
  const Ending ending = executives.Await(executive, 40000);
  EXPECT_TRUE(IsVerdict(ending.code)) << ending.code << ending.log;
  ExpectNothingTwice(witness);
}

TEST_F(Killed, SimulatorInASearchEndsTheEpisodeBeforeAnythingIsDone) {
  Process supervisor = Up("200");
  ASSERT_TRUE(AllReady(1));
  Process executive = Executive("search");
  ASSERT_TRUE(witness.Until([&] { return Searching(witness); }, 15000));
  const int dead = Kill("simulator");
  ExpectServiceLost(executives.Await(executive, 2 * kStatedMs), "simulator");
  EXPECT_TRUE(witness.commands.empty());
  EXPECT_EQ(executives.Result().at("outcome"), "stopped");
  EXPECT_EQ(executives.Result().at("exit_code"), 15);
  EXPECT_TRUE(BackWithin("simulator", dead, kStatedMs));
  ExpectTheNextEpisodeWorks({"--policy", "plan:0"}, 4);
}

TEST_F(Killed, ExecutiveInASearchFreesWorkersAndServers) {
  Process supervisor = Up("200");
  ASSERT_TRUE(AllReady(1));
  Process executive = Executive("search");
  ASSERT_TRUE(witness.Until([&] { return Searching(witness); }, 15000));
  const auto state = [&] {
    const auto workers = witness.Services("worker");
    return workers.empty() ? -1 : workers.front().state;
  };
  ASSERT_TRUE(witness.Until([&] { return state() == health_t::STATE_BUSY; }, 3000));
  executive.Signal(SIGKILL);
  EXPECT_TRUE(witness.Until([&] { return state() == health_t::STATE_READY; }, kStatedMs));
  EXPECT_TRUE(witness.commands.empty());
  // A threshold that no plan reaches: the answer of a search, and the world stays as it is.
  ExpectTheNextEpisodeWorks({"--samples", "3", "--refusal-threshold", "1"}, 3);
}

TEST_F(Killed, WorkerInAnActionIsBackForTheNextSearch) {
  Process supervisor = Up("30");
  ASSERT_TRUE(AllReady(1));
  Process executive = executives.Start({"--samples", "6"});
  ASSERT_TRUE(witness.Until([&] { return Acting(witness); }, 20000));
  const std::size_t searches = witness.roots.back().executed.size();
  const int dead = Kill("worker-1");
  EXPECT_TRUE(BackWithin("worker-1", dead, kStatedMs));
  const auto next_search = [&] { return witness.roots.back().executed.size() > searches; };
  EXPECT_TRUE(witness.Until(next_search, 20000)) << "the first action should succeed here";
  EXPECT_TRUE(witness.Until([&] { return Searching(witness); }, kStatedMs));
  const Ending ending = executives.Await(executive, 40000);
  EXPECT_TRUE(IsVerdict(ending.code)) << ending.code << ending.log;
  ExpectNothingTwice(witness);
}

TEST_F(Killed, ModelServerInAnActionIsBackForTheNextSearch) {
  Process supervisor = Up("30");
  ASSERT_TRUE(AllReady(1));
  Process executive = executives.Start({"--samples", "6"});
  ASSERT_TRUE(witness.Until([&] { return Acting(witness); }, 20000));
  const int dead = Kill("model");
  EXPECT_TRUE(BackWithin("model", dead, kStatedMs));
  const auto next_search = [&] { return !witness.roots.back().executed.empty(); };
  EXPECT_TRUE(witness.Until(next_search, 20000)) << "the first action should succeed here";
  EXPECT_TRUE(witness.Until([&] { return Searching(witness); }, kStatedMs));
  const Ending ending = executives.Await(executive, 40000);
  EXPECT_TRUE(IsVerdict(ending.code)) << ending.code << ending.log;
  ExpectNothingTwice(witness);
}

// The scene that comes back has the same seed: it must not pass for the one that was acted on.
TEST_F(Killed, SimulatorInAnActionEndsTheEpisode) {
  Options options;
  options.workers = 1;
  options.simulator = {"--frames-per-second", "15", "--seed", std::to_string(kSeed)};
  Process supervisor = Supervised::Start(options);
  ASSERT_TRUE(AllReady(1));
  Process executive = executives.Start({"--policy", "plan:0,1,2"});
  ASSERT_TRUE(witness.Until([&] { return Acting(witness); }, 20000));
  const int dead = Kill("simulator");
  ExpectServiceLost(executives.Await(executive, 2 * kStatedMs), "simulator");
  EXPECT_EQ(executives.Result().at("outcome"), "stopped");
  EXPECT_EQ(executives.Result().at("acts").at(0).at("observed"), "unknown");
  EXPECT_TRUE(BackWithin("simulator", dead, kStatedMs));
  const std::size_t heard = witness.statuses.size();
  witness.Listen(1500);
  ASSERT_GT(witness.statuses.size(), heard);
  for (std::size_t i = heard; i < witness.statuses.size(); ++i) {
    const int state = witness.statuses[i].state;
    EXPECT_TRUE(state == action_status_t::STATE_IDLE || state == action_status_t::STATE_REFUSED)
        << "the command must not be carried out again by the new simulator: " << state;
  }
  ExpectNothingTwice(witness);
  ExpectTheNextEpisodeWorks({"--policy", "plan:0"}, 4);
}

TEST_F(Killed, ExecutiveInAnActionStopsTheRobot) {
  Process supervisor = Up("5");
  ASSERT_TRUE(AllReady(1));
  Process executive = Executive("plan:0,1,2");
  ASSERT_TRUE(witness.Until([&] { return Acting(witness); }, 20000));
  executive.Signal(SIGKILL);
  const std::int64_t killed_ms = SteadyMs();
  const auto cancelled = [&] {
    return witness.statuses.back().state == action_status_t::STATE_CANCELLED;
  };
  EXPECT_TRUE(witness.Until(cancelled, kStatedMs));
  EXPECT_LT(SteadyMs() - killed_ms, 4500) << "3 s of silence";
  // It brakes for at most ten ticks, and then holds still.
  witness.Listen(2500);
  const std::int64_t frame = witness.labels.rbegin()->first;
  witness.Listen(1000);
  EXPECT_EQ(witness.labels.rbegin()->first, frame) << "it should stand still";
  ExpectNothingTwice(witness);
}

// Nobody starts again what was killed.
class Unsupervised : public testing::Test {
 protected:
  Unsupervised()
      : deployment(std::string("unsupervised_") +
                   testing::UnitTest::GetInstance()->current_test_info()->name()),
        executives(witness, deployment.folder),
        simulator(deployment.Simulator({"--frames-per-second", "15"})),
        server(deployment.ModelServer({"--fixed-cost", "120,0"})),
        worker(deployment.Worker()) {}

  Process Executive(const std::string& policy) {
    return executives.Start({"--policy", policy, "--samples", "100000"});
  }

  Witness witness;
  Deployment deployment;
  Executives executives;
  Process& simulator;
  Process& server;
  Process& worker;
};

TEST_F(Unsupervised, TheOnlyWorkerInASearch) {
  Process executive = Executive("search");
  ASSERT_TRUE(witness.Until([&] { return Searching(witness); }, 20000));
  worker.Signal(SIGKILL);
  ExpectServiceLost(executives.Await(executive, 2 * kStatedMs), "no workers");
  EXPECT_TRUE(witness.commands.empty());
}

TEST_F(Unsupervised, TheOnlyModelServerInASearch) {
  Process executive = Executive("search");
  ASSERT_TRUE(witness.Until([&] { return Searching(witness); }, 20000));
  server.Signal(SIGKILL);
  ExpectServiceLost(executives.Await(executive, 2 * kStatedMs), "no servers");
  EXPECT_TRUE(witness.commands.empty());
}

TEST_F(Unsupervised, TheSimulatorInASearch) {
  Process executive = Executive("search");
  ASSERT_TRUE(witness.Until([&] { return Searching(witness); }, 20000));
  simulator.Signal(SIGKILL);
  ExpectServiceLost(executives.Await(executive, 2 * kStatedMs), "simulator or robot fell silent");
  EXPECT_TRUE(witness.commands.empty());
}

TEST_F(Unsupervised, TheSimulatorInAnAction) {
  Process executive = Executive("plan:0,1,2");
  ASSERT_TRUE(witness.Until([&] { return Acting(witness); }, 20000));
  simulator.Signal(SIGKILL);
  ExpectServiceLost(executives.Await(executive, 2 * kStatedMs), "silent");
  EXPECT_EQ(executives.Result().at("outcome"), "stopped");
}

}  // namespace
}  // namespace prospect::tests
