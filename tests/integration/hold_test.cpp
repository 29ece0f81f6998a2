// One executive at a time: whoever's command is accepted first holds the robot, others are told so
// and change nothing, and it is free again when the holder leaves or dies.

#include <gtest/gtest.h>
#include <signal.h>

#include <set>
#include <string>
#include <vector>

#include "tests/integration/support/deployment.h"
#include "tests/integration/support/stops_in_time.h"

namespace prospect::tests {
namespace {

// Slow enough that an action lasts many seconds.
const std::vector<std::string> kSlow{"--frames-per-second", "4"};

// An executive beside the deployment's own, with results of its own.
class Rival {
 public:
  Rival(const Deployment& deployment, const std::string& name, std::vector<std::string> more)
      : folder_(deployment.folder + "/" + name),
        process_("prospect-executive", With(std::move(more), folder_), folder_ + ".log") {}

  int EndOf(Witness& witness, int timeout_ms = 30000) {
    int code = -1;
    witness.Until([&] { return (code = process_.Wait(0)) >= 0; }, timeout_ms);
    return code;
  }
  std::string Log() const { return ReadText(folder_ + ".log"); }
  nlohmann::json Result() const {
    return nlohmann::json::parse(ReadText(folder_ + "/result.json"), nullptr, false);
  }

 private:
  static std::vector<std::string> With(std::vector<std::string> more, const std::string& out) {
    more.insert(more.end(), {"--objects", "7", "--legs", "3", "--out", out});
    return more;
  }

  std::string folder_;
  Process process_;
};

bool UnderWay(const Witness& witness) {
  return LatestStatusIs(witness, action_status_t::STATE_RUNNING) && !witness.labels.empty() &&
         witness.labels.rbegin()->second.frame >= 4;
}

std::set<std::int64_t> Commanders(const Witness& witness) {
  std::set<std::int64_t> ids;
  for (const auto& command : witness.commands) ids.insert(command.executive_id);
  return ids;
}

void ExpectBusy(Rival& rival, Witness& witness, std::int64_t holder) {
  EXPECT_EQ(rival.EndOf(witness), 15) << rival.Log();
  const std::string busy = "busy, held by executive " + std::to_string(holder);
  EXPECT_NE(rival.Log().find(busy), std::string::npos) << rival.Log();
  EXPECT_EQ(rival.Result().at("exit_code"), 15);
  EXPECT_TRUE(rival.Result().at("acts").empty());
}

TEST(Holding, ASecondExecutiveIsToldWhoHoldsTheRobot) {
  Witness witness;
  Deployment deployment("held");
  ASSERT_TRUE(deployment.Up(witness, 1, kSlow));
  auto& first = deployment.Executive({"--policy", "plan:0,1,2"});
  ASSERT_TRUE(witness.Until([&] { return UnderWay(witness); }, 15000));
  const std::int64_t holder = witness.statuses.back().holder_id;
  EXPECT_EQ(Commanders(witness), std::set<std::int64_t>{holder});
  const std::int64_t episode = witness.episode_id;

  Rival with_reset(deployment, "reset", {"--seed", "1500001", "--policy", "plan:0,1,2"});
  ExpectBusy(with_reset, witness, holder);
  Rival as_it_stands(deployment, "as_it_stands", {"--no-reset", "--policy", "plan:0,1,2"});
  ExpectBusy(as_it_stands, witness, holder);
  Rival onlooker(deployment, "onlooker", {"--no-reset", "--explain-only", "--samples", "50"});
  const int looked = onlooker.EndOf(witness);
  EXPECT_TRUE(looked == 0 || looked == 3) << "who only looks needs no hold: " << onlooker.Log();

  EXPECT_EQ(witness.episode_id, episode);
  EXPECT_EQ(Commanders(witness), std::set<std::int64_t>{holder}) << "nothing was even asked for";
  EXPECT_TRUE(LatestStatusIs(witness, action_status_t::STATE_RUNNING));
  EXPECT_EQ(witness.statuses.back().executive_id, holder);
  EXPECT_TRUE(first.Running());
  const std::int64_t frame = witness.labels.rbegin()->first;
  EXPECT_TRUE(witness.Until([&] { return witness.labels.rbegin()->first > frame + 3; }, 10000))
      << "the first one goes on";
}

TEST(Holding, OfTwoAtOnceOneActs) {
  Witness witness;
  Deployment deployment("held_at_once");
  deployment.Simulator();
  ASSERT_TRUE(witness.Until([&] { return witness.Ready("simulator", 1); }, 20000));
  Rival one(deployment, "one", {"--seed", "1500001", "--policy", "plan:0,1,2"});
  Rival other(deployment, "other", {"--seed", "1500002", "--policy", "plan:0,1,2"});
  const int code = one.EndOf(witness, 60000), other_code = other.EndOf(witness, 60000);
  EXPECT_NE(code == 15, other_code == 15) << one.Log() << other.Log();
  const int acted = code == 15 ? other_code : code;
  EXPECT_TRUE(acted == 0 || acted == 4) << acted;
  EXPECT_EQ(Commanders(witness).size(), 1u);
}

TEST(Holding, AnExecutiveThatDiedFreesTheRobotForTheNext) {
  Witness witness;
  Deployment deployment("held_by_the_dead");
  deployment.Simulator(kSlow);
  auto& first = deployment.Executive({"--policy", "plan:0,1,2"});
  ASSERT_TRUE(witness.Until([&] { return UnderWay(witness); }, 15000));
  const std::int64_t dead = witness.statuses.back().holder_id;
  first.Signal(SIGKILL);
  Rival next(deployment, "next", {"--seed", "1500001", "--policy", "plan:0,1,2"});
  const auto obeyed = [&] {
    return LatestStatusIs(witness, action_status_t::STATE_RUNNING) &&
           witness.statuses.back().executive_id != dead;
  };
  EXPECT_TRUE(witness.Until(obeyed, 15000)) << next.Log();
  EXPECT_EQ(witness.statuses.back().holder_id, witness.statuses.back().executive_id);
}

TEST(Holding, WhoHasEndedHoldsNothing) {
  Witness witness;
  Deployment deployment("held_no_more");
  deployment.Simulator();
  for (int i = 0; i < 2; ++i) {
    Rival rival(deployment, "run" + std::to_string(i), {"--policy", "plan:0,1,2"});
    const int code = rival.EndOf(witness, 60000);
    EXPECT_TRUE(code == 0 || code == 4) << rival.Log();
    const auto free = [&] {
      return !witness.statuses.empty() && witness.statuses.back().holder_id == 0;
    };
    EXPECT_TRUE(witness.Until(free, 2000)) << "at once, not after its silence";
  }
}

}  // namespace
}  // namespace prospect::tests
