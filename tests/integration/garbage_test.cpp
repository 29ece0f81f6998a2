// Bytes that are no messages, on every channel: nobody falls over, HEALTH counts them, and work
// goes on.

#include <gtest/gtest.h>

#include <random>
#include <string>

#include "lcmtypes/schema.h"
#include "services/common/channels.h"
#include "tests/integration/support/deployment.h"

namespace prospect::tests {
namespace {

std::vector<std::uint8_t> RandomBytes(std::mt19937& random, std::size_t size) {
  std::vector<std::uint8_t> bytes(size);
  for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random());
  return bytes;
}

// The right fingerprint, and nonsense behind it.
std::vector<std::uint8_t> Forged(const std::string& type, std::mt19937& random, std::size_t size) {
  auto bytes = RandomBytes(random, size + 8);
  const auto fingerprint = static_cast<std::uint64_t>(messages::FindByName(type)->fingerprint);
  for (int i = 0; i < 8; ++i)
    bytes[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(fingerprint >> (56 - 8 * i));
  return bytes;
}

void SprayGarbage(services::Bus& bus, std::mt19937& random) {
  for (const auto& channel : services::Channels()) {
    bus.PublishRaw(channel.name, {});
    bus.PublishRaw(channel.name, RandomBytes(random, random() % 300));
    bus.PublishRaw(channel.name, Forged(channel.type_name, random, random() % 2000));
    bus.PublishRaw(channel.name, Forged(channel.type_name, random, 4));
  }
}

TEST(Garbage, IsRefusedCountedAndSurvived) {
  Witness witness;
  Deployment deployment("garbage");
  ASSERT_TRUE(deployment.Up(witness, 1));
  std::mt19937 random(7);
  const auto all_count = [&] {
    for (const char* service : {"simulator", "model", "worker"}) {
      const auto alive = witness.Services(service);
      if (alive.empty() || alive.front().refused < 20) return false;
    }
    return true;
  };
  ASSERT_TRUE(witness.Until(all_count, 20000, [&] { SprayGarbage(witness.bus, random); }));

  auto& executive = deployment.Executive();
  int code = -1;
  ASSERT_TRUE(witness.Until([&] { return (code = executive.Wait(0)) >= 0; }, 60000,
                            [&] { SprayGarbage(witness.bus, random); }));
  EXPECT_TRUE(code == 0 || code == 4) << code;
  EXPECT_FALSE(deployment.Result().at("actions").empty());
  for (const char* service : {"simulator", "model", "worker"})
    EXPECT_TRUE(witness.Ready(service, 1)) << service;
}

}  // namespace
}  // namespace prospect::tests
