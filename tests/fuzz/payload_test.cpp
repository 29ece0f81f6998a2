// Malformed payloads, made from real messages, for every type that travels alone. None may crash,
// throw, or ask for more than 64 MB of memory. PROSPECT_FUZZ_PAYLOADS says how many in all.

#include <gtest/gtest.h>

#include <cstdlib>
#include <stdexcept>

#include "services/common/channels.h"
#include "tests/fuzz/corpus.h"
#include "tests/fuzz/heap_watch.h"
#include "tests/fuzz/mutation.h"
#include "tests/fuzz/one_payload.h"

namespace prospect::fuzz {
namespace {

constexpr std::size_t kMostMemory = 64 << 20;

int PayloadsPerType() {
  const char* wanted = std::getenv("PROSPECT_FUZZ_PAYLOADS");
  const int all = wanted ? std::atoi(wanted) : 340000;
  return all / static_cast<int>(Targets().size());
}

TEST(Targets, AreTheTypesOfAllChannels) {
  ASSERT_EQ(Targets().size(), services::Channels().size());
  for (const auto& channel : services::Channels())
    EXPECT_NE(FindTarget(channel.type_name), nullptr) << channel.type_name;
}

TEST(HeapWatch, SeesEveryAllocation) {
  const std::size_t before = BytesAsked();
  std::vector<char> block(1 << 20);
  EXPECT_GE(BytesAsked() - before, block.size());
}

TEST(Corpus, HoldsSoundMessagesOfTodaysTypes) {
  for (const Target& target : Targets()) {
    for (const Bytes& message : Corpus(target.type)) {
      EXPECT_TRUE(target.feed(message.data(), message.size()))
          << target.type << ": recorded before the type changed? Run tests/fuzz/record_corpus.sh";
    }
  }
}

class Payloads : public testing::TestWithParam<Target> {};

TEST_P(Payloads, DoNoHarm) {
  const Target& target = GetParam();
  const auto corpus = Corpus(target.type);
  std::mt19937_64 random(11);
  std::size_t most = 0;
  int accepted = 0;
  const int payloads = PayloadsPerType();
  for (int i = 0; i < payloads; ++i) {
    const Bytes payload = Mutate(corpus, random);
    const std::size_t before = BytesAsked();
    ASSERT_NO_THROW(accepted += target.feed(payload.data(), payload.size()) ? 1 : 0)
        << "payload " << i;
    most = std::max(most, BytesAsked() - before);
    ASSERT_LT(most, kMostMemory) << "payload " << i << " of " << payload.size() << " bytes";
  }
  EXPECT_LT(accepted, payloads);
  EXPECT_GT(accepted, 0) << "no payload got as far as the decoder";
  RecordProperty("accepted", accepted);
  RecordProperty("most_bytes", static_cast<int>(most));
}

INSTANTIATE_TEST_SUITE_P(Of, Payloads, testing::ValuesIn(Targets()),
                         [](const auto& each) { return std::string(each.param.type); });

}  // namespace
}  // namespace prospect::fuzz
