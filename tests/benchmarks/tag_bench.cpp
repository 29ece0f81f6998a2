// tag_bench: what a deployment's key costs a message: microseconds to sign and to verify it,
// medians of 21 rounds.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "lcmtypes/checked_codec.h"
#include "lcmtypes/messages.h"
#include "services/common/authenticity.h"

namespace {

using namespace prospect;
using namespace prospect::services;

double Median(const std::function<void()>& work) {
  constexpr int kRounds = 21, kRepeats = 2000;
  std::vector<double> rounds;
  for (int round = 0; round < kRounds; ++round) {
    const auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < kRepeats; ++i) work();
    const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - start;
    rounds.push_back(took.count() / kRepeats);
  }
  std::nth_element(rounds.begin(), rounds.begin() + kRounds / 2, rounds.end());
  return rounds[kRounds / 2];
}

void Measure(const char* name, const std::vector<std::uint8_t>& message) {
  const BusKey key{{1, 2, 3}};
  MessageSigner signer(key);
  std::vector<std::uint8_t> bytes;
  const double sign = Median([&] {
    bytes = message;
    signer.Sign("CHANNEL", &bytes);
  });
  KeyedMac mac(key);
  std::uint8_t tag[KeyedMac::kBytes];
  const double verify = Median([&] { mac.Compute("CHANNEL", bytes.data(), bytes.size(), tag); });
  std::printf("%-28s %7zu bytes  sign %6.2f us  verify %6.2f us\n", name, message.size(), sign,
              verify);
}

}  // namespace

int main() {
  Measure("ACTION_COMMAND", messages::CheckedEncode(action_command_t{}));
  health_t health{};
  health.counters.resize(20);
  for (auto& counter : health.counters) counter.name = "EXPAND_REPLY: not authentic";
  messages::SetCounts(health);
  Measure("HEALTH, 20 counters", messages::CheckedEncode(health));
  expand_request_t request{};
  request.paths.assign(8, path_t{4, {1, 2, 3, 4}});
  messages::SetCounts(request);
  Measure("EXPAND_REQUEST, 8 paths", messages::CheckedEncode(request));
  expand_reply_t reply{};
  evaluation_t evaluation{};
  evaluation.path = path_t{4, {1, 2, 3, 4}};
  evaluation.actions.resize(8), evaluation.q.resize(8), evaluation.p.resize(8);
  reply.evaluations.assign(16, evaluation);
  messages::SetCounts(reply);
  Measure("EXPAND_REPLY, 16 rows", messages::CheckedEncode(reply));
  observation_t picture{};
  picture.data.resize(64 * 64 * 3);
  messages::SetCounts(picture);
  Measure("OBSERVATION, 64x64", messages::CheckedEncode(picture));
  return 0;
}
