#include <gtest/gtest.h>

#include <sstream>

#include "services/spy/bus_survey.h"
#include "tests/unit/services/poll_until.h"

namespace prospect::services {
namespace {

SurveyRow RowOf(const BusSurvey& survey, const std::string& channel) {
  for (const SurveyRow& row : survey.rows()) {
    if (row.channel == channel) return row;
  }
  ADD_FAILURE() << "no row for " << channel;
  return {};
}

RawMessage Message(const std::string& channel, std::vector<std::uint8_t> bytes) {
  return {channel, 0, std::move(bytes), nullptr};
}

TEST(Survey, CountsByChannelAndKnowsTypes) {
  BusSurvey survey;
  const auto stop = messages::CheckedEncode(search_stop_t{});
  for (int i = 0; i < 3; ++i) survey.Add(Message("SEARCH_STOP", stop));
  survey.Add(Message("SEARCH_STOP", {stop.begin(), stop.end() - 1}));
  survey.Add(Message("STRANGE", {1, 2, 3, 4, 5, 6, 7, 8, 9}));
  survey.Add(Message("TASK", stop));  // ours, but on a channel that carries another type
  survey.Add(Message("LCM_SELF_TEST", {1}));

  ASSERT_EQ(survey.rows().size(), 3u);
  EXPECT_EQ(RowOf(survey, "SEARCH_STOP").type, "search_stop_t");
  EXPECT_EQ(RowOf(survey, "SEARCH_STOP").messages, 4);
  EXPECT_EQ(RowOf(survey, "SEARCH_STOP").undecodable, 1);
  EXPECT_EQ(RowOf(survey, "STRANGE").type, "?");
  EXPECT_EQ(RowOf(survey, "STRANGE").undecodable, 1);
  EXPECT_EQ(RowOf(survey, "TASK").undecodable, 1);
}

TEST(Survey, TellsTaggedAndRefusedMessages) {
  BusSurvey survey;
  auto tagged = messages::CheckedEncode(search_stop_t{});
  tagged.resize(tagged.size() + 24);
  survey.Add(Message("SEARCH_STOP", tagged));
  RawMessage refused = Message("SEARCH_STOP", tagged);
  refused.refused = "not authentic";
  survey.Add(refused);
  const SurveyRow row = RowOf(survey, "SEARCH_STOP");
  EXPECT_EQ(row.undecodable, 0);
  EXPECT_EQ(row.tagged, 1);
  EXPECT_EQ(row.refused, 1);
  std::ostringstream text;
  survey.Print(1, text);
  EXPECT_NE(text.str().find("1 messages carry a tag"), std::string::npos) << text.str();
}

TEST(Survey, ReportsRates) {
  BusSurvey survey;
  const auto stop = messages::CheckedEncode(search_stop_t{});
  for (int i = 0; i < 10; ++i) survey.Add(Message("SEARCH_STOP", stop));
  const nlohmann::json report = survey.ToJson(4);
  EXPECT_EQ(report["messages"], 10);
  EXPECT_EQ(report["undecodable"], 0);
  EXPECT_EQ(report["rows"][0]["rate_hz"], 2.5);
  EXPECT_EQ(report["rows"][0]["bytes_per_s"], 2.5 * static_cast<double>(stop.size()));
  std::ostringstream text;
  survey.Print(4, text);
  EXPECT_NE(text.str().find("SEARCH_STOP         search_stop_t"), std::string::npos) << text.str();
}

TEST(Survey, SaysWhenNothingWasHeard) {
  std::ostringstream text;
  BusSurvey().Print(1, text);
  EXPECT_NE(text.str().find("nothing was heard"), std::string::npos);
}

// A default message of every type travels the real bus on its channel and is decodable there.
TEST(Survey, EveryChannelOnTheBusDecodes) {
  Bus bus;
  BusSurvey survey;
  const auto subscription =
      bus.SubscribeAll([&](const RawMessage& message) { survey.Add(message); });
  for (const ChannelInfo& channel : Channels()) {
#define PUBLISH(type) \
  if (std::string(channel.type_name) == #type) bus.Publish(channel.name, type{});
    PROSPECT_MESSAGE_TYPES(PUBLISH)
#undef PUBLISH
  }
  ASSERT_TRUE(PollUntil({&bus}, [&] { return survey.rows().size() == Channels().size(); }));
  for (const SurveyRow& row : survey.rows()) {
    EXPECT_EQ(row.undecodable, 0) << row.channel;
    EXPECT_EQ(row.type, FindChannel(row.channel)->type_name);
  }
}

}  // namespace
}  // namespace prospect::services
