// Bytes that are no messages, on every channel: nobody falls over, HEALTH counts them, and work
// goes on.

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <random>
#include <string>
#include <vector>

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

// Whatever a host may send to the bus's address and port, below LCM's own format.
class DatagramSource {
 public:
  explicit DatagramSource(const std::string& url) : socket_(::socket(AF_INET, SOCK_DGRAM, 0)) {
    const std::string prefix = "udpm://";
    const std::size_t colon = url.find(':', prefix.size());
    address_.sin_family = AF_INET;
    address_.sin_port = htons(static_cast<std::uint16_t>(std::stoi(url.substr(colon + 1))));
    inet_pton(AF_INET, url.substr(prefix.size(), colon - prefix.size()).c_str(),
              &address_.sin_addr);
    const unsigned char ttl = 0;
    setsockopt(socket_, IPPROTO_IP, IP_MULTICAST_TTL, &ttl, sizeof ttl);
  }
  ~DatagramSource() { close(socket_); }

  bool Send(const std::vector<std::uint8_t>& bytes) {
    return sendto(socket_, bytes.data(), bytes.size(), 0,
                  reinterpret_cast<const sockaddr*>(&address_),
                  sizeof address_) == static_cast<ssize_t>(bytes.size());
  }

 private:
  int socket_;
  sockaddr_in address_{};
};

// LCM's word for "a message" (2) or "a part of one" (3), and nonsense behind it: no end of the
// channel's name, parts of messages of any size, number and place.
std::vector<std::uint8_t> HalfAnLcmPacket(std::uint8_t kind, std::mt19937& random) {
  std::vector<std::uint8_t> bytes{'L', 'C', '0', kind};
  const auto rest = RandomBytes(random, random() % 60);
  bytes.insert(bytes.end(), rest.begin(), rest.end());
  return bytes;
}

TEST(Garbage, DatagramsThatAreNotOfLcmAreSurvived) {
  Witness witness;
  Deployment deployment("datagrams");
  ASSERT_TRUE(deployment.Up(witness, 1));
  DatagramSource source(witness.bus.url());
  std::mt19937 random(11);
  int sent = 0;
  const auto spray = [&] {
    sent += source.Send({}) + source.Send(RandomBytes(random, random() % 1400)) +
            source.Send(HalfAnLcmPacket('2', random)) + source.Send(HalfAnLcmPacket('3', random));
  };
  auto& executive = deployment.Executive();
  int code = -1;
  ASSERT_TRUE(witness.Until([&] { return (code = executive.Wait(0)) >= 0; }, 60000, spray));
  EXPECT_GT(sent, 100);
  EXPECT_TRUE(code == 0 || code == 4) << code;
  for (const char* service : {"simulator", "model", "worker"})
    EXPECT_TRUE(witness.Ready(service, 1)) << service;
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
