// A worker's journal repeats its choices; a bus log rebuilds what a listener knew.

#include <gtest/gtest.h>
#include <lcm/eventlog.h>
#include <unistd.h>

#include <filesystem>

#include "base/exit_error.h"
#include "planner/scripted_tree.h"
#include "services/binding/search_messages.h"
#include "services/binding/search_table.h"
#include "services/binding/statistics_messages.h"
#include "services/binding/task_messages.h"
#include "services/replay/bus_replay.h"
#include "services/replay/journal_replay.h"
#include "services/worker/journal.h"

namespace prospect::services {
namespace {

constexpr int kBudget = 4000;

task_t TreeTask() {
  task_t task{};
  task.name = "scripted-tree";
  task.num_actions = planner::ScriptedTree::kBranching;
  for (int a = 0; a < task.num_actions; ++a) task.initial.push_back(a);
  task.num_initial = task.num_actions;
  for (int a = 0; a < task.num_actions; ++a) {
    action_t action{};
    action.index = a;
    action.name = "action " + std::to_string(a);
    action.successors = task.initial;
    action.num_successors = task.num_actions;
    task.actions.push_back(action);
  }
  task.plan_length = planner::ScriptedTree::kDepth;
  task.repeats_allowed = 1;
  task.image_width = task.image_height = 16;
  task.tick_seconds = 0.1;
  task.action_time_limit = 10;
  task.task_hash = TaskHash(task);
  return task;
}

search_root_t TreeRoot(std::int64_t seed) {
  search_root_t root{};
  root.search_id = 77 + seed;
  root.task = "scripted-tree";
  root.task_hash = TreeTask().task_hash;
  root.plan_length = TreeTask().plan_length;
  root.time_left = -1;
  root.leaves = 2;
  root.budget_ms = -1;
  root.sharing = 1;
  planner::SearchParameters parameters;
  parameters.samples = 300;
  parameters.depth = planner::ScriptedTree::kDepth;
  parameters.seed = static_cast<std::uint64_t>(seed);
  SetParameters(parameters, &root);
  return root;
}

expand_reply_t ReplyTo(const search_root_t& root, const std::vector<planner::Path>& paths) {
  expand_reply_t reply{};
  reply.search_id = root.search_id;
  reply.status = expand_reply_t::STATUS_OK;
  const auto rules = planner::ScriptedTree::Rules();
  for (const auto& path : paths) {
    const auto evaluation =
        planner::ScriptedTree{static_cast<std::uint64_t>(root.seed)}.Evaluate(path);
    reply.evaluations.push_back(ToMessage(path, evaluation, rules.AllowedActions({}, path)));
  }
  reply.num_evaluations = static_cast<std::int32_t>(reply.evaluations.size());
  return reply;
}

/// A log of the bus, as lcm-logger writes it.
class LogFile {
 public:
  explicit LogFile(const std::string& path) : log_(lcm_eventlog_create(path.c_str(), "w")) {}
  ~LogFile() { lcm_eventlog_destroy(log_); }
  template <class T>
  void Add(const T& message, std::int64_t utime) {
    auto bytes = messages::CheckedEncode(message);
    std::string channel = ChannelOf<T>();
    lcm_eventlog_event_t event{};
    event.timestamp = utime;
    event.channellen = static_cast<int>(channel.size());
    event.datalen = static_cast<int>(bytes.size());
    event.channel = channel.data();
    event.data = bytes.data();
    lcm_eventlog_write_event(log_, &event);
  }

 private:
  lcm_eventlog_t* log_;
};

class ReplayTest : public testing::Test {
 protected:
  ReplayTest()
      : folder_(std::filesystem::temp_directory_path() /
                ("prospect_replay_" + std::to_string(getpid()))) {
    std::filesystem::create_directories(folder_);
  }
  ~ReplayTest() override { std::filesystem::remove_all(folder_); }
  std::string File(const std::string& name) const { return (folder_ / name).string(); }

  // A worker's search from beginning to end, each step journaled and all that the bus would carry
  // logged. Another worker's request rides along. Returns the table it ends with.
  std::string Search(std::int64_t seed, Journal* journal, LogFile* bus) {
    const auto root = TreeRoot(seed);
    std::int64_t now = 1'000'000 * (seed + 1);
    bus->Add(TreeTask(), now);
    bus->Add(root, now);
    journal->Heard(TreeTask(), now);
    SharedSearch shared(root, RulesFromTask(TreeTask()), kWriter, 3, now);
    journal->Begun(root, now);
    for (; !shared.search().finished(now); now += 1000) {
      if (now % 20'000 == 0) Tell(&shared, journal, bus, now);
      const int wanted = std::max(0, root.leaves - shared.search().waiting());
      const auto asked = shared.search().Advance(wanted, now);
      journal->Advanced(wanted, asked, now);
      const auto reply = ReplyTo(root, asked);
      bus->Add(reply, now);
      journal->Heard(reply, now);
      shared.Hear(reply);
    }
    Tell(&shared, journal, bus, now);
    shared.search().Stop();
    journal->Stopped(now);
    return TableText(shared.search());
  }

  void Tell(SharedSearch* shared, Journal* journal, LogFile* bus, std::int64_t now) {
    const auto rows = ToMessage(shared->search().MakeBatch(kBudget, now), kLeaseMs);
    journal->Sent(rows, kBudget, now);
    bus->Add(rows, now);
  }

  static constexpr std::int64_t kWriter = 4711;
  std::filesystem::path folder_;
};

TEST_F(ReplayTest, AJournalRepeatsEverySelectionAndABusLogEveryTable) {
  std::vector<std::string> tables;
  {
    Journal journal(File("journal.lcmlog"), kWriter, 3);
    LogFile bus(File("bus.lcmlog"));
    for (std::int64_t seed = 0; seed < 3; ++seed) tables.push_back(Search(seed, &journal, &bus));
  }
  const JournalReplay journal = ReplayJournal(File("journal.lcmlog"));
  EXPECT_EQ(journal.searches, 3);
  EXPECT_GT(journal.selections, 300);
  EXPECT_GT(journal.sent, 3);
  EXPECT_EQ(journal.differences, 0) << journal.first_difference;

  const auto searches = ReplayBusLog(File("bus.lcmlog"));
  ASSERT_EQ(searches.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_TRUE(TableText(searches[i].search->search()) == tables[i]);
  EXPECT_TRUE(tables[0] != tables[1]);
}

TEST_F(ReplayTest, OneWorkerAndOneSeedGiveTheSameTreeEveryTime) {
  std::vector<std::string> tables;
  for (int i = 0; i < 2; ++i) {
    Journal journal(File("journal.lcmlog"), kWriter, 3);
    LogFile bus(File("bus.lcmlog"));
    tables.push_back(Search(5, &journal, &bus));
  }
  EXPECT_TRUE(tables[0] == tables[1]);
}

TEST_F(ReplayTest, AMissingStepShows) {
  {
    Journal journal(File("journal.lcmlog"), kWriter, 3);
    const auto root = TreeRoot(0);
    journal.Heard(TreeTask(), 0);
    journal.Begun(root, 0);
    journal.Advanced(2, {{}}, 0);
    // The root's evaluation was heard, but is not in the journal.
    journal.Advanced(2, {{3}}, 1000);
    journal.Stopped(1000);
  }
  EXPECT_GT(ReplayJournal(File("journal.lcmlog")).differences, 0);
}

TEST_F(ReplayTest, WhatIsNoJournalIsRefused) {
  LogFile(File("bus.lcmlog")).Add(TreeTask(), 1);
  EXPECT_THROW(ReplayJournal(File("bus.lcmlog")), ExitError);
  EXPECT_THROW(ReplayJournal(File("missing.lcmlog")), ExitError);
}

}  // namespace
}  // namespace prospect::services
