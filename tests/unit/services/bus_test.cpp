#include "services/common/bus.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <memory>
#include <thread>

#include "tests/unit/services/poll_until.h"

namespace prospect::services {
namespace {

search_stop_t Stop(std::int64_t search_id, const std::string& reason = "budget") {
  search_stop_t message{};
  message.search_id = search_id;
  message.reason = reason;
  return message;
}

TEST(Bus, CarriesMessagesToAnotherBus) {
  Bus sender;
  Bus receiver;
  std::vector<std::int64_t> heard;
  const auto subscription = receiver.Subscribe<search_stop_t>(
      [&](const search_stop_t& stop) { heard.push_back(stop.search_id); });
  for (std::int64_t id = 1; id <= 100; ++id) ASSERT_TRUE(sender.Publish(Stop(id)));
  ASSERT_TRUE(PollUntil({&receiver}, [&] { return heard.size() == 100; }));
  for (std::size_t i = 0; i < heard.size(); ++i)
    EXPECT_EQ(heard[i], static_cast<std::int64_t>(i + 1));
  EXPECT_EQ(receiver.counters().at("SEARCH_STOP").received, 100);
}

TEST(Bus, AProcessHearsItself) {
  Bus bus;
  int heard = 0;
  const auto subscription = bus.Subscribe<search_stop_t>([&](const search_stop_t&) { ++heard; });
  bus.Publish(Stop(1));
  EXPECT_TRUE(PollUntil({&bus}, [&] { return heard == 1; }));
}

// One picture a tick is the heaviest steady load: all of a paced burst must arrive.
TEST(Bus, CarriesPictures) {
  Bus bus;
  observation_t picture{};
  picture.encoding = observation_t::ENCODING_RGB8;
  picture.width = picture.height = 64;
  picture.data.resize(64 * 64 * 3);
  messages::SetCounts(picture);
  std::int64_t last = -1;
  const auto subscription = bus.Subscribe<observation_t>([&](const observation_t& seen) {
    EXPECT_EQ(seen.frame, last + 1);
    last = seen.frame;
  });
  for (int i = 0; i < 50; ++i) {
    picture.frame = i;
    bus.Publish(picture);
    bus.Poll(1);
  }
  EXPECT_TRUE(PollUntil({&bus}, [&] { return last == 49; }));
}

TEST(Bus, RefusesAndCountsBadBytesByChannelAndReason) {
  Bus bus;
  int heard = 0;
  const auto subscription = bus.Subscribe<search_stop_t>([&](const search_stop_t&) { ++heard; });
  std::vector<std::uint8_t> bytes = messages::CheckedEncode(Stop(1));
  bus.PublishRaw("SEARCH_STOP", {bytes.begin(), bytes.begin() + 20});
  bus.PublishRaw("SEARCH_STOP", {1, 2, 3});
  bytes.push_back(0);
  bus.PublishRaw("SEARCH_STOP", bytes);
  bus.Publish("SEARCH_STOP", path_t{0, {}});
  search_stop_t nonsense = Stop(1);
  nonsense.epoch = -1;
  bus.Publish(nonsense);
  bus.Publish(Stop(2));
  ASSERT_TRUE(PollUntil({&bus}, [&] { return heard == 1; }));
  const std::map<std::string, std::int64_t> expected = {
      {"truncated", 2}, {"trailing", 1}, {"fingerprint", 1}, {"value epoch: negative", 1}};
  EXPECT_EQ(bus.counters().at("SEARCH_STOP").refused, expected);
  EXPECT_EQ(bus.refused(), 5);
  EXPECT_EQ(bus.received(), 1);
}

TEST(Bus, CountsWhatTheCallerRefuses) {
  Bus bus;
  bus.CountRefused("ACTION_COMMAND", "unknown action");
  EXPECT_EQ(bus.counters().at("ACTION_COMMAND").refused.at("unknown action"), 1);
  EXPECT_EQ(bus.refused(), 1);
}

TEST(Bus, ChannelNamesAreNoRegularExpressions) {
  Bus bus;
  int heard = 0;
  const auto subscription =
      bus.Subscribe<search_stop_t>("A.B", [&](const search_stop_t&) { ++heard; });
  bus.Publish("AxB", Stop(1));
  bus.Publish("A.B", Stop(2));
  bus.Publish("A.B", Stop(3));
  ASSERT_TRUE(PollUntil({&bus}, [&] { return heard == 2; }));
  EXPECT_EQ(bus.counters().count("AxB"), 0u);
}

TEST(Bus, ServesSeveralHandlersOfOneChannel) {
  Bus bus;
  std::string order;
  const auto subscription =
      bus.Subscribe<search_stop_t>([&](const search_stop_t&) { order += 'a'; });
  const auto second_subscription =
      bus.Subscribe<search_stop_t>([&](const search_stop_t&) { order += 'b'; });
  bus.Publish(Stop(1));
  ASSERT_TRUE(PollUntil({&bus}, [&] { return order.size() == 2; }));
  EXPECT_EQ(order, "ab");
  EXPECT_EQ(bus.received(), 1);
  EXPECT_THROW(static_cast<void>(bus.Subscribe<plan_t>("SEARCH_STOP", [](const plan_t&) {})),
               std::logic_error);
}

// The exception reaches Poll()'s caller past no C frame, and neither the bus nor later messages
// suffer.
TEST(Bus, HandlersMayThrow) {
  Bus bus;
  int heard = 0;
  const auto subscription = bus.Subscribe<search_stop_t>([&](const search_stop_t& stop) {
    ++heard;
    if (stop.search_id == 1) throw std::runtime_error("handler");
  });
  bus.Publish(Stop(1));
  bus.Publish(Stop(2));
  EXPECT_THROW(PollUntil({&bus}, [&] { return heard == 2; }), std::runtime_error);
  EXPECT_TRUE(PollUntil({&bus}, [&] { return heard == 2; }));
}

TEST(Bus, HandlersMaySubscribeAndPublish) {
  Bus bus;
  bool answered = false;
  Subscription inner;
  const auto subscription = bus.Subscribe<search_stop_t>([&](const search_stop_t&) {
    inner = bus.Subscribe<predict_request_t>("ANSWER",
                                             [&](const predict_request_t&) { answered = true; });
    bus.Publish("ANSWER", predict_request_t{});
  });
  bus.Publish(Stop(1));
  EXPECT_TRUE(PollUntil({&bus}, [&] { return answered; }));
}

TEST(Subscription, EndsWithItsHandle) {
  Bus bus;
  int first = 0, second = 0;
  auto ends = bus.Subscribe<search_stop_t>([&](const search_stop_t&) { ++first; });
  const auto stays = bus.Subscribe<search_stop_t>([&](const search_stop_t&) { ++second; });
  bus.Publish(Stop(1));
  ASSERT_TRUE(PollUntil({&bus}, [&] { return second == 1; }));
  ends = Subscription();
  bus.Publish(Stop(2));
  ASSERT_TRUE(PollUntil({&bus}, [&] { return second == 2; }));
  EXPECT_EQ(first, 1);
}

TEST(Subscription, MovesWithItsHandle) {
  Bus bus;
  int heard = 0;
  std::vector<Subscription> held;
  {
    auto subscription = bus.Subscribe<search_stop_t>([&](const search_stop_t&) { ++heard; });
    held.push_back(std::move(subscription));
  }
  bus.Publish(Stop(1));
  EXPECT_TRUE(PollUntil({&bus}, [&] { return heard == 1; }));
}

// An object that holds its subscriptions is not called once it is gone, be it that the handler
// before its own has destroyed it.
TEST(Subscription, AHandlerMayEndTheOneAfterIt) {
  struct Listener {
    explicit Listener(Bus& bus)
        : subscription(bus.Subscribe<search_stop_t>([this](const search_stop_t&) { ++*heard; })) {}
    std::unique_ptr<int> heard = std::make_unique<int>(0);
    Subscription subscription;
  };
  Bus bus;
  std::unique_ptr<Listener> listener;
  int ended = 0;
  const auto killer = bus.Subscribe<search_stop_t>([&](const search_stop_t&) {
    listener.reset();
    ++ended;
  });
  listener = std::make_unique<Listener>(bus);
  bus.Publish(Stop(1));
  EXPECT_TRUE(PollUntil({&bus}, [&] { return ended == 1; }));
}

TEST(Subscription, AHandlerMayEndItselfAndRunsToItsEnd) {
  Bus bus;
  int heard = 0, others = 0;
  Subscription own;
  own = bus.Subscribe<search_stop_t>([&, kept = std::string(100, 'x')](const search_stop_t&) {
    own = Subscription();
    heard += static_cast<int>(kept.size());  // the handler's own memory
  });
  const auto other = bus.Subscribe<search_stop_t>([&](const search_stop_t&) { ++others; });
  bus.Publish(Stop(1));
  bus.Publish(Stop(2));
  ASSERT_TRUE(PollUntil({&bus}, [&] { return others == 2; }));
  EXPECT_EQ(heard, 100);
}

TEST(Subscription, MayOutliveItsBus) {
  Subscription subscription, raw;
  auto bus = std::make_unique<Bus>();
  subscription = bus->Subscribe<search_stop_t>([](const search_stop_t&) {});
  bus = std::make_unique<Bus>();
  raw = bus->SubscribeAll([](const RawMessage&) {});
  bus.reset();
}

TEST(Subscription, WhatNobodyHearsAnyMoreIsNeitherReadNorCounted) {
  Bus bus;
  int heard = 0;
  auto ends = bus.Subscribe<search_stop_t>([](const search_stop_t&) {});
  const auto stays = bus.Subscribe<plan_t>([&](const plan_t&) { ++heard; });
  ends = Subscription();
  bus.Publish(Stop(1));
  bus.Publish(plan_t{});
  ASSERT_TRUE(PollUntil({&bus}, [&] { return heard == 1; }));
  EXPECT_EQ(bus.counters().count("SEARCH_STOP"), 0u);
}

TEST(Subscription, ToAllChannelsEndsToo) {
  Bus bus;
  int first = 0, second = 0;
  const auto count = [](int* number) {
    return [number](const RawMessage& message) { *number += message.channel == "ANYTHING"; };
  };
  auto ends = bus.SubscribeAll(count(&first));
  bus.PublishRaw("ANYTHING", {1});
  ASSERT_TRUE(PollUntil({&bus}, [&] { return first == 1; }));
  ends = Subscription();
  const auto stays = bus.SubscribeAll(count(&second));
  bus.PublishRaw("ANYTHING", {1});
  ASSERT_TRUE(PollUntil({&bus}, [&] { return second > 0; }));
  EXPECT_EQ(second, 1) << "and LCM brings each message once";
  EXPECT_EQ(first, 1);
}

TEST(Bus, PublishThrowsWhenACountIsWrong) {
  Bus bus;
  EXPECT_THROW(bus.Publish("PATHS", path_t{2, {}}), messages::EncodeError);
}

TEST(Bus, PublishSaysWhenAMessageCannotBeSent) {
  Bus bus;
  EXPECT_FALSE(bus.PublishRaw(std::string(100, 'X'), {1}));  // longer than LCM's 63 bytes
}

TEST(Bus, PollWaitsNoLongerThanAsked) {
  Bus bus;
  const std::int64_t start_ms = SteadyMs();
  EXPECT_EQ(bus.Poll(20), 0);
  EXPECT_GE(SteadyMs() - start_ms, 19);
  EXPECT_LT(SteadyMs() - start_ms, 2000);
}

TEST(Bus, WakeEndsAPollFromAnotherThread) {
  Bus bus;
  std::thread waker([&] { bus.Wake(); });
  const std::int64_t start_ms = SteadyMs();
  bus.Poll(60000);
  EXPECT_LT(SteadyMs() - start_ms, 30000);
  waker.join();
}

TEST(Bus, AFloodLeavesTheLoopItsTurns) {
  Bus bus;
  const auto subscription = bus.Subscribe<expand_request_t>([](const expand_request_t&) {});
  expand_request_t request{};
  request.paths = {{0, {}}};
  messages::SetCounts(request);
  for (int i = 0; i < 3000; ++i) bus.Publish(request);
  int most = 0;
  std::int64_t total = 0;
  const std::int64_t end_ms = SteadyMs() + 5000;
  while (total < 600 && SteadyMs() < end_ms) {
    const int taken = bus.Poll(5);
    most = std::max(most, taken);
    total += taken;
  }
  EXPECT_GE(total, 600);  // loss is normal, but not of nearly all
  EXPECT_LE(most, Bus::kMaxPerPoll);
}

TEST(Bus, SubscribeAllHearsEveryChannelUnchecked) {
  Bus bus;
  std::vector<std::string> channels;
  const auto subscription = bus.SubscribeAll([&](const RawMessage& message) {
    if (message.channel != "LCM_SELF_TEST") channels.push_back(message.channel);
  });
  bus.PublishRaw("ANYTHING", {1, 2, 3});
  bus.Publish(Stop(1));
  ASSERT_TRUE(PollUntil({&bus}, [&] { return channels.size() == 2; }));
  EXPECT_EQ(channels, (std::vector<std::string>{"ANYTHING", "SEARCH_STOP"}));
}

TEST(Bus, BadUrlsAreErrorsThatSayWhatToDo) {
  try {
    Bus bus("nonsense://x");
    FAIL() << "no error";
  } catch (const BusError& error) {
    EXPECT_EQ(error.code(), kExitBus);
    EXPECT_NE(std::string(error.what()).find("udpm://"), std::string::npos);
  }
}

TEST(Bus, PortsDoNotHearEachOther) {
  Bus bus;
  Bus other("udpm://239.255.76.67:29999?ttl=0");
  int here = 0;
  int there = 0;
  const auto subscription = bus.Subscribe<search_stop_t>([&](const search_stop_t&) { ++here; });
  const auto second_subscription =
      other.Subscribe<search_stop_t>([&](const search_stop_t&) { ++there; });
  bus.Publish(Stop(1));
  ASSERT_TRUE(PollUntil({&bus, &other}, [&] { return here == 1; }));
  other.Poll(50);
  EXPECT_EQ(there, 0);
}

void Append(std::uint64_t number, int bytes, std::vector<std::uint8_t>* to) {
  for (int i = bytes - 1; i >= 0; --i) to->push_back(static_cast<std::uint8_t>(number >> (8 * i)));
}

// A part of a message by LCM's format, whatever its numbers say.
std::vector<std::uint8_t> Part(std::uint32_t size, std::uint32_t offset, std::uint16_t number,
                               std::uint16_t parts, const std::string& rest) {
  std::vector<std::uint8_t> bytes{'L', 'C', '0', '3'};
  Append(1, 4, &bytes);
  Append(size, 4, &bytes);
  Append(offset, 4, &bytes);
  Append(number, 2, &bytes);
  Append(parts, 2, &bytes);
  bytes.insert(bytes.end(), rest.begin(), rest.end());
  return bytes;
}

std::vector<std::uint8_t> Whole(const std::string& rest) {
  const std::string text = std::string("LC02\0\0\0\1", 8) + rest;
  return {text.begin(), text.end()};
}

void SendToDefaultGroup(const std::vector<std::uint8_t>& datagram) {
  const int file = socket(AF_INET, SOCK_DGRAM, 0);
  sockaddr_in group{};
  group.sin_family = AF_INET;
  group.sin_port = htons(7667);
  inet_pton(AF_INET, "239.255.76.67", &group.sin_addr);
  const unsigned char ttl = 0;
  setsockopt(file, IPPROTO_IP, IP_MULTICAST_TTL, &ttl, sizeof ttl);
  sendto(file, datagram.data(), datagram.size(), 0, reinterpret_cast<sockaddr*>(&group),
         sizeof group);
  close(file);
}

// LCM 1.3.1 itself ends by each of these, before anything of ours looks at them.
TEST(Bus, DatagramsThatWouldEndLcmAreKeptOut) {
  const std::string channel = std::string("SEARCH_STOP") + '\0';
  const std::vector<std::vector<std::uint8_t>> harmful = {
      {},
      {'L', 'C', '0'},
      Whole(""),
      Whole("SEARCH_STOP"),  // no end of the channel's name
      Whole(std::string(200, 'X')),
      Part(100000, 0xffffff00, 0, 3, channel + std::string(512, 'x')),
      Part(100000, 1, 0, 3, channel + std::string(512, 'x')),
      Part(100000, 0xfffffff0, 1, 3, std::string(512, 'x')),
      Part(0xffffffff, 0, 0, 3, channel + std::string(512, 'x')),
      Part(1000, 0, 0, 3, "SEARCH_STOP"),
      Part(1000, 0, 7, 3, std::string(512, 'x')),
      {'L', 'C', '0', '3', 0, 0, 0, 1, 0, 0, 0, 9},
  };
  Bus bus;
  std::vector<std::int64_t> heard;
  const auto subscription = bus.Subscribe<search_stop_t>(
      [&](const search_stop_t& stop) { heard.push_back(stop.search_id); });
  for (int round = 1; round <= 20; ++round) {
    for (const auto& datagram : harmful) SendToDefaultGroup(datagram);
    bus.Publish(Stop(round, std::string(100000, 'x')));  // in two parts: those that are right
    ASSERT_TRUE(PollUntil({&bus}, [&] { return !heard.empty() && heard.back() == round; }));
  }
  EXPECT_EQ(heard.size(), 20u);
  EXPECT_EQ(bus.refused(), 0) << "kept out by the kernel, before LCM";
}

// Of one deployment: they hear each other, themselves, and nobody else.
TEST(KeyedBus, HearsWhoeverHasTheKeyAndCountsTheOthers) {
  const BusKey key{{1}}, other_key{{2}};
  Bus sender("", "", &key), receiver("", "", &key), stranger("", "", &other_key), open;
  std::vector<std::int64_t> heard, openly;
  const auto subscription = receiver.Subscribe<search_stop_t>(
      [&](const search_stop_t& stop) { heard.push_back(stop.search_id); });
  const auto second_subscription = open.Subscribe<search_stop_t>(
      [&](const search_stop_t& stop) { openly.push_back(stop.search_id); });
  sender.Publish(Stop(1));
  stranger.Publish(Stop(2));
  open.Publish(Stop(3));
  sender.Publish(Stop(4));
  receiver.Publish(Stop(5));
  ASSERT_TRUE(PollUntil({&receiver}, [&] { return heard.size() == 3; }));
  EXPECT_EQ(heard, (std::vector<std::int64_t>{1, 4, 5}));
  const std::map<std::string, std::int64_t> expected = {{"not authentic", 2}};
  EXPECT_EQ(receiver.counters().at("SEARCH_STOP").refused, expected);
  EXPECT_EQ(receiver.received(), 3);
  EXPECT_TRUE(receiver.keyed());
  EXPECT_FALSE(open.keyed());

  ASSERT_TRUE(PollUntil({&open}, [&] { return open.refused() == 4; }));
  EXPECT_EQ(openly, (std::vector<std::int64_t>{3})) << "a tag is not taken for part of a message";
}

TEST(KeyedBus, WhatIsPlayedAgainIsRefused) {
  const BusKey key{{1}};
  Bus sender("", "", &key), receiver("", "", &key), recorder;
  int heard = 0;
  std::vector<RawMessage> recorded;
  const auto subscription =
      receiver.Subscribe<search_stop_t>([&](const search_stop_t&) { ++heard; });
  const auto second_subscription = recorder.SubscribeAll([&](const RawMessage& message) {
    if (message.channel == "SEARCH_STOP") recorded.push_back(message);
  });
  sender.Publish(Stop(1));
  ASSERT_TRUE(PollUntil({&receiver, &recorder}, [&] { return heard == 1 && !recorded.empty(); }));
  const auto bytes = recorded.front().bytes;
  for (int i = 0; i < 3; ++i) recorder.PublishRaw("SEARCH_STOP", bytes);
  sender.Publish(Stop(2));
  ASSERT_TRUE(PollUntil({&receiver}, [&] { return heard == 2; }));
  EXPECT_EQ(receiver.counters().at("SEARCH_STOP").refused.at("replayed"), 3);
}

TEST(KeyedBus, SubscribeAllShowsMessagesWithoutTagsAndWhatIsRefused) {
  const BusKey key{{1}};
  Bus sender("", "", &key), reader("", "", &key), open;
  std::vector<RawMessage> seen;
  const auto subscription = reader.SubscribeAll([&](const RawMessage& message) {
    if (message.channel == "SEARCH_STOP") seen.push_back(message);
  });
  sender.Publish(Stop(1));
  open.Publish(Stop(1));
  ASSERT_TRUE(PollUntil({&reader}, [&] { return seen.size() == 2; }));
  EXPECT_EQ(seen[0].bytes, messages::CheckedEncode(Stop(1)));
  EXPECT_EQ(seen[0].refused, nullptr);
  EXPECT_STREQ(seen[1].refused, "not authentic");
}

}  // namespace
}  // namespace prospect::services
