// How far a bus reaches: datagrams from another host are heard only where the URL says so. Run
// under tests/integration/with_hosts.sh 2.

#include <gtest/gtest.h>
#include <lcm/lcm.h>

#include <cstdlib>
#include <string>

#include "tests/integration/support/process.h"
#include "tests/integration/support/witness.h"
#include "tests/unit/services/poll_until.h"

namespace prospect::tests {
namespace {

constexpr char kHere[] = "10.77.0.1";
constexpr char kGroup[] = "239.255.76.67";

std::string Url(int port, int ttl) {
  return std::string("udpm://") + kGroup + ":" + std::to_string(port) +
         "?ttl=" + std::to_string(ttl);
}

/// LCM as it comes: what our bus is measured against.
class PlainLcm {
 public:
  explicit PlainLcm(int port) : lcm_(lcm_create(Url(port, 0).c_str())) {
    lcm_subscribe(lcm_, "SEARCH_STOP", &PlainLcm::Count, &heard_);
  }
  ~PlainLcm() { lcm_destroy(lcm_); }

  bool Hears() {
    for (int i = 0; i < 100 && heard_ == 0; ++i) lcm_handle_timeout(lcm_, 50);
    return heard_ > 0;
  }

 private:
  static void Count(const lcm_recv_buf_t*, const char*, void* heard) {
    ++*static_cast<int*>(heard);
  }

  lcm_t* lcm_;
  int heard_ = 0;
};

class Reach : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    const char* hosts = std::getenv("PROSPECT_HOSTS");
    if (!hosts) GTEST_SKIP() << "run it under tests/integration/with_hosts.sh 2";
    if (std::atoi(hosts) < 2) GTEST_SKIP() << std::getenv("PROSPECT_HOSTS_WHY");
    const std::string route = std::string("ip route replace 224.0.0.0/4 dev ") + GetParam();
    ASSERT_EQ(std::system(route.c_str()), 0);
  }

  // Another host sends "search 7 is over" to an address, as LCM would.
  void SendFromOutside(const std::string& address, int port) {
    Process stranger(
        "/usr/bin/env",
        {"ip", "netns", "exec", "host2", std::string(PROSPECT_BUILD) + "/tests/fault-stranger",
         address, std::to_string(port)},
        MakeFolder("reach") + "/stranger.log");
    ASSERT_EQ(stranger.Wait(10000), 0);
  }
};

// Multicast goes by the loopback interface, as doctor sets it, or by the one that joins the hosts,
// as a default route has it. Either way it stays on the machine, and hears the machine.
TEST_P(Reach, ABusOfThisMachineHearsNothingFromOutside) {
  services::Bus bus(Url(7701, 0));
  std::vector<std::int64_t> heard;
  const auto subscription = bus.Subscribe<search_stop_t>(
      [&](const search_stop_t& stop) { heard.push_back(stop.search_id); });
  SendFromOutside(kHere, 7701);
  SendFromOutside(kGroup, 7701);
  // A word of our own waits in the same queue: once it is heard, the others have been, too, or
  // never will be.
  search_stop_t own{};
  own.search_id = 1;
  bus.Publish(own);
  ASSERT_TRUE(services::PollUntil({&bus}, [&] { return !heard.empty(); }));
  EXPECT_EQ(heard, std::vector<std::int64_t>{1});
}

// Why: so that the test above is known to be able to fail.
TEST_P(Reach, PlainLcmHearsADatagramToTheMachine) {
  PlainLcm plain(7702);
  SendFromOutside(kHere, 7702);
  EXPECT_TRUE(plain.Hears());
}

class NetworkReach : public Reach {};

TEST_P(NetworkReach, HearsItsGroupAndNoDatagramToTheMachine) {
  services::Bus bus(Url(7703, 1));
  std::vector<std::int64_t> heard;
  const auto subscription = bus.Subscribe<search_stop_t>(
      [&](const search_stop_t& stop) { heard.push_back(stop.search_id); });
  SendFromOutside(kHere, 7703);
  search_stop_t own{};
  own.search_id = 1;
  bus.Publish(own);
  ASSERT_TRUE(services::PollUntil({&bus}, [&] { return !heard.empty(); }));
  EXPECT_EQ(heard, std::vector<std::int64_t>{1});
  SendFromOutside(kGroup, 7703);
  ASSERT_TRUE(services::PollUntil({&bus}, [&] { return heard.size() == 2; }));
  EXPECT_EQ(heard.back(), 7);
}

std::string Interface(const testing::TestParamInfo<const char*>& one) { return one.param; }
INSTANTIATE_TEST_SUITE_P(MulticastBy, Reach, testing::Values("lo", "eth0"), Interface);
INSTANTIATE_TEST_SUITE_P(MulticastBy, NetworkReach, testing::Values("eth0"), Interface);

}  // namespace
}  // namespace prospect::tests
