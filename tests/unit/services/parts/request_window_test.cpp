#include "services/binding/request_window.h"

#include <gtest/gtest.h>

#include <set>

#include "services/binding/evaluation_messages.h"
#include "services/binding/subtree_counter.h"

namespace prospect::services {
namespace {

constexpr std::int64_t kClient = 7;
constexpr std::int64_t kWeights = 99;

search_root_t Root() {
  search_root_t root{};
  root.search_id = 5;
  root.epoch = 1;
  root.weights_hash = kWeights;
  root.budget_ms = -1;
  return root;
}

model_info_t Info(std::int64_t server) {
  model_info_t info{};
  info.server_id = server;
  info.weights_hash = kWeights;
  return info;
}

expand_reply_t Answer(const std::vector<planner::Path>& paths) {
  expand_reply_t reply{};
  reply.search_id = 5;
  reply.epoch = 1;
  reply.status = expand_reply_t::STATUS_OK;
  for (const auto& path : paths) reply.evaluations.push_back(ToMessage(path, {}, {}));
  return reply;
}

expand_reply_t Refusal(std::int64_t request_id, std::int32_t retry_ms) {
  expand_reply_t reply = Answer({});
  reply.status = retry_ms > 0 ? expand_reply_t::STATUS_BUSY : expand_reply_t::STATUS_REFUSED;
  reply.retry_ms = retry_ms;
  reply.client_ids = {kClient};
  reply.request_ids = {request_id};
  return reply;
}

class RequestWindowTest : public testing::Test {
 protected:
  RequestWindowTest() : window(kClient) {
    window.Begin(Root());
    servers.Hear(Info(100), 0);
  }

  ServerList servers;
  RequestWindow window;
};

TEST_F(RequestWindowTest, SilenceIsAnsweredByResendingWithDoubledWaits) {
  window.Ask({{1}}, servers, 0);
  std::vector<std::int64_t> sent;
  for (std::int64_t now = 0; now <= 200; ++now) {
    for (const auto& request : window.TakeDue(servers, now)) {
      EXPECT_EQ(request.attempt, static_cast<int>(sent.size()));
      sent.push_back(now);
    }
  }
  EXPECT_EQ(sent, (std::vector<std::int64_t>{0, 20, 60, 140}));
  EXPECT_EQ(window.resent(), 3);
}

TEST_F(RequestWindowTest, AnswerEndsTheWait) {
  window.Ask({{1}, {2}}, servers, 0);
  ASSERT_EQ(window.TakeDue(servers, 0).size(), 1u);
  window.Hear(Answer({{1}}), 5);
  EXPECT_FALSE(window.Awaits({1}));
  EXPECT_TRUE(window.Awaits({2}));
  window.Hear(Answer({{2}}), 6);
  EXPECT_EQ(window.awaited_paths(), 0u);
  EXPECT_TRUE(window.TakeDue(servers, 1000).empty());
}

TEST_F(RequestWindowTest, AnswersOfOtherEpochsAreLeftAlone) {
  window.Ask({{1}}, servers, 0);
  auto stale = Answer({{1}});
  stale.epoch = 0;
  window.Hear(stale, 1);
  EXPECT_TRUE(window.Awaits({1}));
}

TEST_F(RequestWindowTest, PathAwaitedIsNotAskedForTwice) {
  window.Ask({{1}}, servers, 0);
  window.Ask({{1}, {3}}, servers, 0);
  EXPECT_EQ(window.awaited_paths(), 2u);
}

TEST_F(RequestWindowTest, BusyServerIsAskedAgainAfterItsHint) {
  window.Ask({{1}}, servers, 0);
  const auto id = window.TakeDue(servers, 0).at(0).request_id;
  EXPECT_TRUE(window.Hear(Refusal(id, 300), 10).empty());
  EXPECT_TRUE(window.TakeDue(servers, 309).empty());
  EXPECT_EQ(window.TakeDue(servers, 310).size(), 1u);
}

TEST_F(RequestWindowTest, RefusalForGoodGivesThePathsBack) {
  window.Ask({{1}, {2}}, servers, 0);
  const auto id = window.TakeDue(servers, 0).at(0).request_id;
  EXPECT_EQ(window.Hear(Refusal(id, 0), 10), (std::vector<planner::Path>{{1}, {2}}));
  EXPECT_EQ(window.awaited_paths(), 0u);
}

TEST_F(RequestWindowTest, SilentServerIsLeftForTheNext) {
  servers.Hear(Info(200), 0);
  window.Ask({{1}}, servers, 0);
  std::set<std::int64_t> asked;
  for (std::int64_t now = 0; now <= 1000; now += 10) {
    for (const auto& request : window.TakeDue(servers, now)) asked.insert(request.server_id);
  }
  EXPECT_EQ(asked, (std::set<std::int64_t>{100, 200}));
}

// A server that dies costs one time-out: what is asked for afterwards goes to the other at once.
TEST_F(RequestWindowTest, AServerThatTimedOutInSilenceIsNotAskedUntilItIsHeard) {
  servers.Hear(Info(200), 0);
  const auto ask = [&](std::uint8_t action, std::int64_t now) {
    window.Ask({{action}}, servers, now);
    return window.TakeDue(servers, now).at(0).server_id;
  };
  const std::int64_t dead = ask(1, 0);
  const std::int64_t other = dead == 100 ? 200 : 100;
  const auto again = window.TakeDue(servers, 20);
  ASSERT_EQ(again.size(), 1u);
  EXPECT_EQ(again[0].server_id, other);
  window.Hear(Answer({{1}}), 21);
  for (std::uint8_t action = 2; action < 12; ++action) EXPECT_EQ(ask(action, 22), other);
  auto alive = Answer({});
  alive.server_id = dead;
  window.Hear(alive, 23);
  std::set<std::int64_t> asked;
  for (std::uint8_t action = 12; action < 40; ++action) asked.insert(ask(action, 24));
  EXPECT_EQ(asked, (std::set<std::int64_t>{100, 200}));
}

TEST_F(RequestWindowTest, AServerHeardMeanwhileIsSlowAndNotDead) {
  servers.Hear(Info(200), 0);
  window.Ask({{1}}, servers, 0);
  const std::int64_t first = window.TakeDue(servers, 0).at(0).server_id;
  auto alive = Answer({});
  alive.server_id = first;
  window.Hear(alive, 5);
  EXPECT_EQ(window.TakeDue(servers, 20).size(), 1u);
  window.Ask({{1, 2}}, servers, 21);
  EXPECT_EQ(window.TakeDue(servers, 21).at(0).server_id, first);
}

TEST_F(RequestWindowTest, WorkSpillsOverWhenPathsWaitLongerThanABatch) {
  servers.Hear(Info(200), 0);
  auto busy_info = Info(100);
  busy_info.batch_ms = 5;
  servers.Hear(busy_info, 0);
  ServerConduct conduct;
  planner::Path path{0};
  while (servers.Choose(path, 0, kWeights, 0) != 100) ++path[0];
  conduct.NoteReply(100, 4, 0);
  EXPECT_EQ(servers.Choose(path, 0, kWeights, 0, conduct), 100);
  conduct.NoteReply(100, 20, 0);
  EXPECT_EQ(servers.Choose(path, 0, kWeights, 0, conduct), 200);
  conduct.NoteReply(200, 18, 0);
  EXPECT_EQ(servers.Choose(path, 0, kWeights, 0, conduct), 100);
}

TEST_F(RequestWindowTest, RequestsTellWhatIsLeftOfTheBudget) {
  auto root = Root();
  root.budget_ms = 100;
  window.Begin(root, 1000);
  window.Ask({{1}}, servers, 1030);
  EXPECT_EQ(window.TakeDue(servers, 1030).at(0).budget_ms, 70);
  root.budget_ms = -1;
  window.Begin(root, 1000);
  window.Ask({{1}}, servers, 1030);
  EXPECT_EQ(window.TakeDue(servers, 1030).at(0).budget_ms, -1);
}

TEST_F(RequestWindowTest, HurrySendsAgainAtOnce) {
  window.Ask({{1}}, servers, 0);
  ASSERT_EQ(window.TakeDue(servers, 0).size(), 1u);
  EXPECT_TRUE(window.TakeDue(servers, 5).empty());
  window.Hurry(5);
  EXPECT_EQ(window.TakeDue(servers, 5).size(), 1u);
}

TEST(SubtreeCounterTest, ThePrefixIsTheShortestThatLeavesEnoughSubtrees) {
  planner::PathTree paths(7);
  SubtreeCounter counter;
  EXPECT_EQ(counter.PrefixLength(paths, 8), 1);
  for (const auto& path : std::vector<planner::Path>{{0}, {1}, {2}}) paths.Add(path);
  EXPECT_EQ(counter.PrefixLength(paths, 3), 1);
  EXPECT_EQ(counter.PrefixLength(paths, 8), 1) << "there are no longer ones yet";
  for (std::uint8_t a = 0; a < 3; ++a)
    for (std::uint8_t b = 3; b < 6; ++b) paths.Add({a, b});
  EXPECT_EQ(counter.PrefixLength(paths, 8), 2);
}

TEST(ServerListTest, AServerThatGoesMovesOnlyItsOwnPaths) {
  ServerList three, two;
  for (std::int64_t id = 1; id <= 3; ++id) three.Hear(Info(id), 0);
  for (std::int64_t id = 1; id <= 2; ++id) two.Hear(Info(id), 0);
  for (std::uint8_t first = 0; first < 60; ++first) {
    const auto before = three.Choose({first}, 0, kWeights, 0);
    if (before != 3) {
      EXPECT_EQ(two.Choose({first}, 0, kWeights, 0), before);
    }
  }
}

TEST(ServerListTest, PathsOfOneFirstActionStayTogether) {
  ServerList servers;
  for (std::int64_t id = 1; id <= 3; ++id) servers.Hear(Info(id), 0);
  std::set<std::int64_t> used;
  for (std::uint8_t first = 0; first < 30; ++first) {
    const auto server = servers.Choose({first}, 0, kWeights, 0);
    EXPECT_EQ(servers.Choose({first, 4, 2}, 0, kWeights, 0), server);
    used.insert(server);
  }
  EXPECT_EQ(used.size(), 3u);
}

TEST(ServerListTest, SilentOrUnfitServersAreNotAsked) {
  ServerList servers;
  servers.Hear(Info(1), 0);
  EXPECT_EQ(servers.Choose({1}, 0, kWeights, 3000), 1);
  EXPECT_EQ(servers.Choose({1}, 0, kWeights, 3001), 0);
  EXPECT_EQ(servers.Choose({1}, 0, kWeights + 1, 0), 0);
}

}  // namespace
}  // namespace prospect::services
