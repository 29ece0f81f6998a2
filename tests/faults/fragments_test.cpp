// Messages above 64 kB, which LCM sends in several datagrams: whether those of two robots, mingled,
// are put together again. Run on a bus of its own (tests/integration/with_bus.sh).

#include <gtest/gtest.h>
#include <lcm/lcm.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <string>
#include <thread>
#include <vector>

#include "cli/options/bus.h"

namespace prospect::tests {
namespace {

constexpr char kChannel[] = "FRAGMENTS";
constexpr int kPictures = 30;
constexpr int kTickMs = 100;
constexpr std::size_t kSenders = 2;

std::string Url() {
  const char* url = std::getenv("LCM_DEFAULT_URL");
  return url && *url ? url : cli::kDefaultBusUrl;
}

/// What a sender's pictures hold in every byte.
std::uint8_t MarkOf(std::size_t sender) { return static_cast<std::uint8_t>(sender + 1); }

void Send(std::size_t sender, std::size_t bytes) {
  lcm_t* lcm = lcm_create(Url().c_str());
  const std::vector<std::uint8_t> picture(bytes, MarkOf(sender));
  for (int i = 0; i < kPictures; ++i) {
    lcm_publish(lcm, kChannel, picture.data(), static_cast<unsigned>(bytes));
    std::this_thread::sleep_for(std::chrono::milliseconds(kTickMs));
  }
  lcm_destroy(lcm);
}

struct Heard {
  std::size_t bytes = 0;
  std::array<int, kSenders> whole = {};
  int broken = 0;

  static void Take(const lcm_recv_buf_t* buffer, const char*, void* self) {
    Heard& heard = *static_cast<Heard*>(self);
    const auto* data = static_cast<const std::uint8_t*>(buffer->data);
    const std::size_t sender = buffer->data_size > 0 ? data[0] - std::size_t{1} : kSenders;
    const bool whole = buffer->data_size == heard.bytes && sender < kSenders &&
                       std::all_of(data, data + buffer->data_size,
                                   [&](std::uint8_t byte) { return byte == data[0]; });
    ++(whole ? heard.whole[sender] : heard.broken);
  }
};

TEST(Fragments, OfTwoSendersArePutTogether) {
  Heard heard;
  heard.bytes = std::size_t{256} * 256 * 3;
  lcm_t* lcm = lcm_create(Url().c_str());
  ASSERT_NE(lcm, nullptr);
  lcm_subscribe(lcm, kChannel, &Heard::Take, &heard);
  std::vector<std::thread> senders;
  for (std::size_t i = 0; i < kSenders; ++i) senders.emplace_back(Send, i, heard.bytes);
  while (lcm_handle_timeout(lcm, 20 * kTickMs) > 0) {
  }
  for (std::thread& sender : senders) sender.join();
  lcm_destroy(lcm);
  EXPECT_EQ(heard.broken, 0);
  // A busy machine may lose one or two.
  for (const int whole : heard.whole) EXPECT_GE(whole, kPictures - 2);
}

}  // namespace
}  // namespace prospect::tests
