#include "tests/faults/counts.h"

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "services/common/clock.h"

namespace prospect::tests {
namespace {

bool Connects(const sockaddr_in& to) {
  const int file = socket(AF_INET, SOCK_STREAM, 0);
  const bool open = connect(file, reinterpret_cast<const sockaddr*>(&to), sizeof to) == 0;
  close(file);
  return open;
}

}  // namespace

std::int64_t Counter(const health_t& health, const std::string& name) {
  for (const auto& counter : health.counters) {
    if (counter.name == name) return counter.value;
  }
  return 0;
}

std::int64_t RolloutsTold(const Witness& witness) {
  std::int64_t made = 0;
  for (const auto& worker : witness.Services("worker")) made += Counter(worker, "rollouts");
  return made;
}

bool PortOpens(const std::string& address, int port, int timeout_ms) {
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(static_cast<std::uint16_t>(port));
  inet_pton(AF_INET, address.c_str(), &to.sin_addr);
  const std::int64_t end_ms = services::SteadyMs() + timeout_ms;
  while (!Connects(to)) {
    if (services::SteadyMs() > end_ms) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return true;
}

}  // namespace prospect::tests
