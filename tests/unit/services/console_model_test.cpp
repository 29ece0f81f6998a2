// The console's model: what a page shows, from messages.

#include <gtest/gtest.h>

#include "lcmtypes/checked_codec.h"
#include "services/binding/evaluation_messages.h"
#include "services/binding/statistics_messages.h"
#include "services/binding/task_messages.h"
#include "services/common/channels.h"
#include "services/console/console_model.h"
#include "services/console/picture_asker.h"
#include "services/console/viewer_feed.h"

namespace prospect::services::console {
namespace {

using nlohmann::json;

constexpr std::int64_t kEpisode = 7, kSearch = 11;

// A bus that only this test speaks on.
class ConsoleModelTest : public testing::Test {
 protected:
  template <class T>
  void Hear(T message) {
    messages::SetCounts(message);
    now_us_ += 1000;
    model_.Take({now_us_, ChannelOf<T>(), messages::CheckedEncode(message), ""});
  }

  // Three actions of which any may follow any other; two make a plan.
  void HearTask(const std::string& name = "a") {
    task_t task{};
    task.name = "test";
    for (int i = 0; i < 3; ++i) {
      action_t action{};
      action.index = i;
      action.name = name + std::to_string(i);
      action.kind = "kind";
      action.successors = {0, 1, 2};
      action.num_successors = 3;
      task.actions.push_back(action);
    }
    task.initial = {0, 1, 2};
    task.plan_length = 2;
    task.image_width = task.image_height = 8;
    task.tick_seconds = 0.1;
    task.action_time_limit = 10;
    messages::SetCounts(task);
    task.task_hash = TaskHash(task);
    task_hash_ = task.task_hash;
    Hear(task);
  }

  void HearRoot(std::int64_t id = kSearch) {
    search_root_t root{};
    root.executive_id = 3;
    root.search_id = id;
    root.task_hash = task_hash_;
    root.task = "test";
    root.episode_id = kEpisode;
    root.image0_id = root.image_id = 1;
    root.plan_length = 2;
    root.time_left = -1;
    root.rule = "paper";
    root.depth = 2;
    root.samples = 10;
    root.leaves = 1;
    root.budget_ms = -1;
    root.sharing = 1;
    Hear(root);
  }

  void HearEvaluation(const planner::Path& path, float value, float done,
                      std::int64_t id = kSearch) {
    planner::Evaluation evaluation{value, done, {0.1f, 0.2f, 0.3f}, {0.9f, 0.9f, 0.9f}};
    expand_reply_t reply{};
    reply.server_id = 5;
    reply.search_id = id;
    reply.status = expand_reply_t::STATUS_OK;
    const std::vector<int> allowed =
        path.size() < 2 ? std::vector<int>{0, 1, 2} : std::vector<int>{};
    reply.evaluations.push_back(ToMessage(path, evaluation, allowed));
    Hear(reply);
  }

  void HearPicture(std::int64_t frame, std::int64_t episode = kEpisode) {
    observation_t seen{};
    seen.episode_id = episode;
    seen.frame = frame;
    seen.encoding = observation_t::ENCODING_RGB8;
    seen.width = seen.height = 8;
    seen.data.assign(8 * 8 * 3, static_cast<std::uint8_t>(frame));
    Hear(seen);
  }

  void HearStatus(std::int8_t state, std::int64_t command, int action, std::int64_t frame) {
    action_status_t status{};
    status.episode_id = kEpisode;
    status.executive_id = status.holder_id = 3;
    status.command_id = command;
    status.action = action;
    status.state = state;
    status.frame = frame;
    Hear(status);
  }

  // Everything that a feed tells until it has no more.
  static std::vector<json> Told(ViewerFeed* feed, ConsoleModel& model, std::int64_t* now_ms) {
    std::vector<json> told;
    for (int quiet = 0; quiet < 2;) {
      *now_ms += ViewerFeed::kPictureMs + 1;
      const auto frame = feed->Next(model, *now_ms);
      quiet = frame ? 0 : quiet + 1;
      if (frame && !frame->binary) told.push_back(json::parse(frame->data));
    }
    return told;
  }

  ConsoleModel model_;
  std::int64_t now_us_ = 1'000'000, task_hash_ = 0;
};

TEST_F(ConsoleModelTest, SaysWhatHappens) {
  EXPECT_EQ(model_.Happening(), "nobody");
  HearTask();
  HearPicture(0);
  EXPECT_EQ(model_.Happening(), "idle");
  HearRoot();
  EXPECT_EQ(model_.Happening(), "thinking");
  search_stop_t stop{};
  stop.search_id = kSearch;
  stop.reason = "samples";
  Hear(stop);
  EXPECT_EQ(model_.Happening(), "idle");
  HearStatus(action_status_t::STATE_RUNNING, 1, 2, 0);
  EXPECT_EQ(model_.Happening(), "acting");
}

TEST_F(ConsoleModelTest, KnowsTheTreeAndWhatChanged) {
  HearTask();
  HearRoot();
  HearEvaluation({}, 0.5f, 1);
  HearEvaluation({1}, 0.8f, 0.5f);
  HearEvaluation({1, 2}, 0.5f, 0.05f);
  SearchView* search = model_.Latest();
  ASSERT_NE(search, nullptr);
  std::uint64_t since = 0;
  const json rows = search->Rows(&since, 100);
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[2][1], rows[1][0]) << "a child names its parent";
  EXPECT_NEAR(rows[1][10].get<double>(), 0.4, 1e-3) << "score: V times f along the path";
  EXPECT_EQ(rows[2][11], "f") << "f ended it";
  EXPECT_NEAR(rows[2][8].get<double>(), 0.3, 1e-3) << "Q as the parent said it";
  EXPECT_TRUE(search->Rows(&since, 100).empty()) << "told once";
  HearEvaluation({0}, 0.9f, 0.9f);
  EXPECT_EQ(search->Rows(&since, 100).size(), 1u) << "only what changed";
}

TEST_F(ConsoleModelTest, ActsEndWithThePictureThatTheirStatusNames) {
  HearTask();
  HearPicture(0);
  HearRoot();
  HearStatus(action_status_t::STATE_RUNNING, 1, 2, 0);
  HearPicture(1);
  HearStatus(action_status_t::STATE_SUCCEEDED, 1, 2, 2);
  ASSERT_EQ(model_.episode().acts().size(), 1u);
  EXPECT_EQ(model_.episode().acts()[0].seen, nullptr) << "frame 2 has not come yet";
  HearPicture(2);
  ASSERT_NE(model_.episode().acts()[0].seen, nullptr);
  EXPECT_EQ(model_.episode().acts()[0].seen->rgb[0], 2);
  EXPECT_EQ(model_.episode().acts()[0].path, planner::Path{2});
}

TEST_F(ConsoleModelTest, ACancelEndsTheActThatRuns) {
  HearTask();
  HearPicture(0);
  HearStatus(action_status_t::STATE_RUNNING, 1, 2, 0);
  HearStatus(action_status_t::STATE_CANCELLED, 2, 2, 0);
  ASSERT_EQ(model_.episode().acts().size(), 1u);
  EXPECT_EQ(model_.episode().acts()[0].state, action_status_t::STATE_CANCELLED);
}

TEST_F(ConsoleModelTest, APersonsWordSaysHowAnActWentThatOnlyEnded) {
  HearTask();
  HearPicture(0);
  HearStatus(action_status_t::STATE_RUNNING, 1, 2, 0);
  HearStatus(action_status_t::STATE_ENDED, 1, 2, 0);
  ASSERT_EQ(model_.episode().acts().size(), 1u);
  EXPECT_EQ(model_.episode().acts()[0].state, action_status_t::STATE_ENDED);
  EXPECT_EQ(model_.episode().ToJson()["acts"][0]["state"], "ended");
  verdict_t verdict{};
  verdict.episode_id = kEpisode;
  verdict.command_id = 1;
  verdict.action = 2;
  verdict.succeeded = 1;
  Hear(verdict);
  EXPECT_EQ(model_.episode().acts()[0].state, action_status_t::STATE_SUCCEEDED);
  verdict.succeeded = 0;
  Hear(verdict);
  EXPECT_EQ(model_.episode().acts()[0].state, action_status_t::STATE_SUCCEEDED) << "said once";
}

TEST_F(ConsoleModelTest, DropsTheOldestSearchesAndSaysSo) {
  ConsoleModel small(/*bytes=*/200'000);
  std::swap(model_, small);
  HearTask();
  for (std::int64_t id = 1; id <= 200; ++id) {
    HearRoot(id);
    for (std::uint8_t a = 0; a < 3; ++a) HearEvaluation({a}, 0.5f, 0.9f, id);
  }
  EXPECT_GT(model_.dropped_searches(), 0);
  EXPECT_LT(model_.bytes(), 200'000u);
  EXPECT_NE(model_.Find(200), nullptr);
  EXPECT_EQ(model_.Find(1), nullptr);
  EXPECT_EQ(model_.State()["dropped_searches"], model_.dropped_searches());
}

TEST_F(ConsoleModelTest, NonsenseIsCountedAndChangesNothing) {
  HearTask();
  const std::uint64_t before = model_.state_revision();
  for (const auto& channel : Channels()) model_.Take({++now_us_, channel.name, {1, 2, 3}, ""});
  model_.Take({++now_us_, "TASK", {1, 2, 3}, "not authentic"});
  EXPECT_EQ(model_.state_revision(), before);
  for (const json& row : model_.Bus()["channels"]) {
    if (row["name"] == "TASK") {
      EXPECT_EQ(row["refused"].size(), 2u) << row;
    }
  }
}

TEST_F(ConsoleModelTest, AStalledViewerGetsWhatIsSoNowAndIsToldWhatItMissed) {
  HearTask();
  HearRoot();
  ViewerFeed feed;
  std::int64_t now_ms = 1000;
  Told(&feed, model_, &now_ms);
  for (int frame = 0; frame < 500; ++frame) HearPicture(frame);
  for (std::uint8_t a = 0; a < 3; ++a) HearEvaluation({a}, 0.5f, 0.9f);
  now_ms += 5000;
  const std::vector<json> told = Told(&feed, model_, &now_ms);
  ASSERT_FALSE(told.empty());
  std::size_t rows = 0;
  double stalled = 0;
  for (const json& message : told) {
    if (message.contains("rows")) rows += message["rows"].size();
    if (message.contains("missed"))
      stalled = std::max(stalled, message["missed"]["stalled_s"].get<double>());
  }
  EXPECT_GE(rows, 3u);
  EXPECT_GE(stalled, 5);
  EXPECT_EQ(feed.missed_pictures(), 0) << "the first picture it ever got misses none";
  for (int frame = 500; frame < 600; ++frame) HearPicture(frame);
  Told(&feed, model_, &now_ms);
  EXPECT_EQ(feed.missed_pictures(), 99);
}

TEST_F(ConsoleModelTest, NamesThatAreNoTextDoNotSpoilTheMessage) {
  HearTask("<b>\xff\x01");
  ViewerFeed feed;
  std::int64_t now_ms = 1000;
  const std::vector<json> told = Told(&feed, model_, &now_ms);
  ASSERT_FALSE(told.empty());
  EXPECT_NE(told[0]["state"]["task"]["actions"][0]["name"].get<std::string>().find("<b>"),
            std::string::npos);
}

TEST(PictureAsker, AsksForOneAtATimeAndSeldomWhileASearchRuns) {
  std::vector<predict_request_t> said;
  PictureAsker asker(9, [&](const predict_request_t& request) { said.push_back(request); });
  for (std::uint8_t a = 0; a < 3; ++a) asker.Want({kSearch, 0, {a}}, false);
  asker.Want({kSearch, 0, {0}}, true);  // known already
  asker.Want({kSearch, 0, {1, 1}}, true);
  const auto absent = [](const PictureAsker::Wish&) { return false; };
  std::int64_t now_ms = 10'000;
  asker.Turn(now_ms, false, absent);
  asker.Turn(now_ms + 1, false, absent);
  ASSERT_EQ(said.size(), 1u);
  EXPECT_EQ(said[0].path.actions, (planner::Path{1, 1})) << "the urgent one first";
  const auto answer = [&] {
    predict_reply_t reply{};
    reply.client_id = 9;
    reply.request_id = said.back().request_id;
    asker.Hear(reply);
  };
  answer();
  asker.Turn(now_ms + 2, true, absent);
  EXPECT_EQ(said.size(), 1u) << "a search runs";
  asker.Turn(now_ms + PictureAsker::kWhileSearchingMs, true, absent);
  ASSERT_EQ(said.size(), 2u);
  EXPECT_EQ(said[1].path.actions, planner::Path{2}) << "then the latest wish";
  for (int i = 0; i < 5; ++i) {
    answer();
    asker.Turn(now_ms + 260 + i, false, absent);
  }
  EXPECT_EQ(said.size(), 4u) << "each once";
}

}  // namespace
}  // namespace prospect::services::console
