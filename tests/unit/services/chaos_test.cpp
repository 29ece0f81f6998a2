#include "services/common/chaos.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/unit/services/poll_until.h"

namespace prospect::services {
namespace {

constexpr int kMany = 10000;

RawMessage Numbered(int number, const std::string& channel = "A") {
  RawMessage message{channel, 0, std::vector<std::uint8_t>(40, 7)};
  for (std::size_t i = 0; i < 4; ++i)
    message.bytes[i] = static_cast<std::uint8_t>(number >> (8 * i));
  return message;
}

int NumberOf(const RawMessage& message) {
  int number = 0;
  for (std::size_t i = 0; i < 4; ++i) number |= message.bytes[i] << (8 * i);
  return number;
}

// What comes out, and when, of `count` messages one a millisecond.
std::vector<std::pair<std::int64_t, RawMessage>> Fate(const std::string& text, int count,
                                                      const std::string& channel = "A") {
  Chaos chaos(ParseChaos(text));
  std::vector<std::pair<std::int64_t, RawMessage>> out;
  for (int now_ms = 0; now_ms < count + 200; ++now_ms) {
    if (now_ms < count) chaos.Take(Numbered(now_ms, channel), now_ms);
    for (auto& message : chaos.Release(now_ms)) out.emplace_back(now_ms, std::move(message));
  }
  return out;
}

std::vector<int> Numbers(const std::string& text, int count, const std::string& channel = "A") {
  std::vector<int> numbers;
  for (const auto& [when, message] : Fate(text, count, channel))
    numbers.push_back(NumberOf(message));
  return numbers;
}

std::vector<int> Counting(int count) {
  std::vector<int> numbers;
  for (int i = 0; i < count; ++i) numbers.push_back(i);
  return numbers;
}

TEST(Chaos, WithSharesOfZeroChangesNothing) {
  EXPECT_EQ(Numbers("drop=0,dup=0,reorder=0,corrupt=0,delay=0,seed=1", 1000), Counting(1000));
}

TEST(Chaos, DropsItsShare) {
  const auto left = Numbers("drop=0.3,seed=1", kMany);
  EXPECT_NEAR(static_cast<double>(left.size()) / kMany, 0.7, 0.02);
  EXPECT_TRUE(std::is_sorted(left.begin(), left.end()));
  EXPECT_TRUE(Numbers("drop=1", 100).empty());
}

TEST(Chaos, RepeatsItsShare) {
  auto heard = Numbers("dup=0.2,seed=1", kMany);
  EXPECT_NEAR(static_cast<double>(heard.size()) / kMany, 1.2, 0.02);
  std::sort(heard.begin(), heard.end());
  heard.erase(std::unique(heard.begin(), heard.end()), heard.end());
  EXPECT_EQ(heard, Counting(kMany));
}

TEST(Chaos, ReordersItsShareAndLosesNothing) {
  auto heard = Numbers("reorder=0.1,seed=1", kMany);
  int overtaken = 0;
  for (std::size_t i = 1; i < heard.size(); ++i) overtaken += heard[i] < heard[i - 1] ? 1 : 0;
  EXPECT_GT(overtaken, kMany / 20);
  std::sort(heard.begin(), heard.end());
  EXPECT_EQ(heard, Counting(kMany));
}

TEST(Chaos, DelaysAllAndKeepsTheirOrder) {
  const auto heard = Fate("delay=20ms", 100);
  ASSERT_EQ(heard.size(), 100u);
  for (int i = 0; i < 100; ++i) {
    EXPECT_EQ(heard[static_cast<std::size_t>(i)].first, i + 20);
    EXPECT_EQ(NumberOf(heard[static_cast<std::size_t>(i)].second), i);
  }
}

TEST(Chaos, CorruptsItsShareAndReallyChangesThem) {
  int changed = 0;
  int shorter = 0;
  for (const auto& [when, message] : Fate("corrupt=0.2,seed=1", kMany)) {
    if (message.bytes == Numbered(static_cast<int>(when)).bytes) continue;
    ++changed;
    if (message.bytes.size() < 40) ++shorter;
  }
  EXPECT_NEAR(static_cast<double>(changed) / kMany, 0.2, 0.02);
  EXPECT_NEAR(static_cast<double>(shorter) / changed, 0.25, 0.05);
}

// A repeat of a corrupted message arrives whole, as a second copy on another way would.
TEST(Chaos, CorruptsOneOfTwo) {
  Chaos chaos(ParseChaos("corrupt=1,dup=1,seed=3"));
  chaos.Take(Numbered(5), 0);
  const auto heard = chaos.Release(1000);
  ASSERT_EQ(heard.size(), 2u);
  const auto whole = [](const RawMessage& m) { return m.bytes == Numbered(5).bytes; };
  EXPECT_EQ(std::count_if(heard.begin(), heard.end(), whole), 1);
}

TEST(Chaos, ASeedRepeatsAFault) {
  const std::string text = "drop=0.3,dup=0.1,reorder=0.1,corrupt=0.1,delay=3";
  const auto trace = [&](const std::string& seed, const std::string& channel) {
    std::vector<std::pair<std::int64_t, std::vector<std::uint8_t>>> seen;
    for (const auto& [when, message] : Fate(text + ",seed=" + seed, 1000, channel))
      seen.emplace_back(when, message.bytes);
    return seen;
  };
  EXPECT_EQ(trace("1", "A"), trace("1", "A"));
  EXPECT_NE(trace("1", "A"), trace("2", "A"));
  EXPECT_NE(trace("1", "A"), trace("1", "B"));
}

// Channels do not shift each other's draws.
TEST(Chaos, WhatBefallsAChannelDoesNotDependOnOthers) {
  Chaos chaos(ParseChaos("drop=0.5,seed=4"));
  std::vector<int> heard;
  for (int i = 0; i < 1000; ++i) {
    chaos.Take(Numbered(i), i);
    for (int k = 0; k < i % 3; ++k) chaos.Take(Numbered(i, "B"), i);
    for (const auto& message : chaos.Release(i))
      if (message.channel == "A") heard.push_back(NumberOf(message));
  }
  EXPECT_EQ(heard, Numbers("drop=0.5,seed=4", 1000));
}

TEST(Chaos, StrikesTheChannelsOfItsRule) {
  EXPECT_TRUE(Numbers("drop=1,channel=SEARCH_.*", 10, "SEARCH_ROOT").empty());
  EXPECT_EQ(Numbers("drop=1,channel=SEARCH_.*", 10, "HEALTH"), Counting(10));
  EXPECT_EQ(Numbers("drop=1,channel=SEARCH", 10, "SEARCH_ROOT"), Counting(10));
  const std::string two = "drop=1,channel=HEALTH;delay=50ms,channel=.*";
  EXPECT_TRUE(Numbers(two, 10, "HEALTH").empty());
  EXPECT_EQ(Fate(two, 10, "PLAN").front().first, 50);
}

TEST(Chaos, SaysHowLongUntilTheNextMessage) {
  Chaos chaos(ParseChaos("delay=20ms"));
  EXPECT_EQ(chaos.Remaining(0, 100), 100);
  EXPECT_EQ(chaos.Remaining(0, -1), -1);
  chaos.Take(Numbered(1), 5);
  EXPECT_EQ(chaos.Remaining(5, 100), 20);
  EXPECT_EQ(chaos.Remaining(5, -1), 20);
  EXPECT_EQ(chaos.Remaining(5, 3), 3);
  EXPECT_EQ(chaos.Remaining(99, 100), 0);
}

TEST(Chaos, CountsWhatItDoes) {
  Chaos chaos(ParseChaos("drop=1,channel=A;dup=1,corrupt=1,reorder=1,delay=5,channel=B"));
  chaos.Take(Numbered(1, "A"), 0);
  chaos.Take(Numbered(1, "B"), 0);
  chaos.Take(Numbered(1, "C"), 0);
  const std::map<std::string, std::int64_t> expected = {
      {"dropped", 1}, {"repeated", 1}, {"held back", 1}, {"corrupted", 1}, {"delayed", 1}};
  EXPECT_EQ(chaos.counters(), expected);
}

TEST(ChaosRules, WithoutASeedDrawOneAndSayIt) {
  const auto one = ParseChaos("drop=0.5").front();
  const auto two = ParseChaos("drop=0.5").front();
  EXPECT_NE(one.seed, two.seed);
  EXPECT_EQ(one.text, "drop=0.5,seed=" + std::to_string(one.seed));
  EXPECT_EQ(ParseChaos(one.text).front().seed, one.seed);
  EXPECT_TRUE(ParseChaos("").empty());
}

TEST(ChaosRules, NameWhatTheyCannotRead) {
  EXPECT_EQ(ChaosDefect("drop=0.3,delay=20ms,dup=0.05,reorder=0.1,corrupt=0.01,seed=1"), "");
  const std::pair<const char*, const char*> cases[] = {
      {"drop=1.5", "drop"},      {"drop=x", "drop"},           {"drop=nan", "drop"},
      {"drop=0.3s", "drop"},     {"delay=-1", "delay"},        {"delay=20s", "delay"},
      {"delay=999999", "delay"}, {"lose=0.1", "lose"},         {"drop", "'drop'"},
      {"channel=(", "channel"},  {"drop=0.1;;drop=0.2", "''"}, {"seed=", "seed"}};
  for (const auto& [text, named] : cases) {
    const std::string defect = ChaosDefect(text);
    EXPECT_NE(defect.find(named), std::string::npos) << text << " -> " << defect;
    EXPECT_NE(defect.find("say for example"), std::string::npos) << text;
  }
}

search_stop_t Stop(std::int64_t search_id) {
  search_stop_t message{};
  message.search_id = search_id;
  return message;
}

TEST(ChaosOnABus, StrikesWhatIsHeardAndNotWhatIsSent) {
  Bus struck("", "drop=1,seed=1");
  Bus whole;
  int here = 0;
  int there = 0;
  const auto subscription = struck.Subscribe<search_stop_t>([&](const search_stop_t&) { ++here; });
  const auto second_subscription =
      whole.Subscribe<search_stop_t>([&](const search_stop_t&) { ++there; });
  for (int i = 0; i < 10; ++i) struck.Publish(Stop(i));
  ASSERT_TRUE(PollUntil({&struck, &whole},
                        [&] { return there == 10 && struck.chaos_counters()["dropped"] == 10; }));
  EXPECT_EQ(here, 0);
  EXPECT_TRUE(whole.chaos_counters().empty());
}

TEST(ChaosOnABus, PollWaitsForWhatIsDelayed) {
  Bus bus("", "delay=30ms");
  std::int64_t heard_ms = 0;
  const auto subscription =
      bus.Subscribe<search_stop_t>([&](const search_stop_t&) { heard_ms = SteadyMs(); });
  const std::int64_t sent_ms = SteadyMs();
  bus.Publish(Stop(1));
  for (int i = 0; i < 100 && heard_ms == 0; ++i) bus.Poll(2000);
  ASSERT_GT(heard_ms, 0);
  EXPECT_GE(heard_ms - sent_ms, 29);
  EXPECT_LT(heard_ms - sent_ms, 1500) << "Poll slept on though a message was due";
}

// What the codec makes of corrupted messages: refused and counted, never another message.
TEST(ChaosOnABus, CorruptedMessagesAreRefused) {
  Bus bus("", "corrupt=0.5,seed=1");
  std::set<std::int64_t> heard;
  const auto subscription = bus.Subscribe<search_stop_t>(
      [&](const search_stop_t& stop) { heard.insert(stop.search_id); });
  constexpr int kSent = 400;
  for (int i = 1; i <= kSent; ++i) {
    bus.Publish(Stop(i));
    ASSERT_TRUE(PollUntil({&bus}, [&] { return bus.received() + bus.refused() == i; }));
  }
  EXPECT_EQ(bus.refused(), bus.chaos_counters()["corrupted"]);
  EXPECT_EQ(static_cast<std::int64_t>(heard.size()), bus.received());
  EXPECT_TRUE(heard.empty() || (*heard.begin() >= 1 && *heard.rbegin() <= kSent));
}

TEST(ChaosOnABus, TheProcessesOwnIsTakenUnlessOneIsGiven) {
  SetChaos("drop=1,seed=1");
  Bus struck;
  Bus other("", "delay=1,seed=1");
  SetChaos("");
  Bus whole;
  int heard[3] = {};
  const auto subscription =
      struck.Subscribe<search_stop_t>([&](const search_stop_t&) { ++heard[0]; });
  const auto second_subscription =
      other.Subscribe<search_stop_t>([&](const search_stop_t&) { ++heard[1]; });
  const auto third_subscription =
      whole.Subscribe<search_stop_t>([&](const search_stop_t&) { ++heard[2]; });
  whole.Publish(Stop(1));
  EXPECT_TRUE(PollUntil({&struck, &other, &whole}, [&] {
    return heard[1] == 1 && heard[2] == 1 && struck.chaos_counters()["dropped"] == 1;
  }));
  EXPECT_EQ(heard[0], 0);
  EXPECT_THROW(SetChaos("nonsense"), std::invalid_argument);
}

}  // namespace
}  // namespace prospect::services
