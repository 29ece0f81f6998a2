// Several hosts: workers in network namespaces of their own, joined by veth pairs and a bridge,
// over multicast and over LCM's TCP relay. Run under tests/integration/with_hosts.sh.

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <climits>
#include <cstdlib>
#include <list>
#include <string>

#include "tests/faults/counts.h"
#include "tests/faults/search_observer.h"
#include "tests/integration/support/deployment.h"

namespace prospect::tests {
namespace {

constexpr int kWorkers = 3;
constexpr char kRelayPort[] = "7700";

std::string NetworkOf(const std::string& pid) {
  std::array<char, PATH_MAX> link{};
  const std::string path = "/proc/" + pid + "/ns/net";
  return readlink(path.c_str(), link.data(), link.size() - 1) > 0 ? link.data() : "";
}

/// One host with simulator, model server and executive, three with a worker each.
class Hosts : public testing::Test {
 protected:
  void SetUp() override {
    const char* hosts = std::getenv("PROSPECT_HOSTS");
    if (!hosts) GTEST_SKIP() << "run it under tests/integration/with_hosts.sh 4";
    if (std::atoi(hosts) < kWorkers + 1) GTEST_SKIP() << std::getenv("PROSPECT_HOSTS_WHY");
  }

  static std::string Chaos() { return "drop=0.1,delay=20ms,seed=" + std::to_string(++seed_); }

  void StartWorkers(const Deployment& deployment) {
    for (int i = 0; i < kWorkers; ++i) {
      const std::string host = "host" + std::to_string(i + 2);
      workers_.emplace_back("/usr/bin/env",
                            std::vector<std::string>{"ip", "netns", "exec", host,
                                                     std::string(PROSPECT_BIN) + "/prospect-worker",
                                                     "--chaos", Chaos()},
                            deployment.folder + "/worker-" + host + ".log");
    }
  }

  // Searches once, always to a refusal, and checks that nothing was miscounted.
  void SearchAndCount(const std::string& name) {
    Witness witness;
    SearchObserver observer(witness.bus);
    Deployment deployment(name);
    deployment.Simulator({"--chaos", Chaos()});
    deployment.ModelServer({"--chaos", Chaos()});
    StartWorkers(deployment);
    ASSERT_TRUE(witness.Until(
        [&] {
          return witness.Ready("simulator", 1) && witness.Ready("model", 1) &&
                 witness.Ready("worker", kWorkers);
        },
        20000))
        << witness.Services("worker").size() << " workers heard; logs in " << deployment.folder;
    auto& executive = deployment.Executive(
        {"--workers", std::to_string(kWorkers), "--chaos", Chaos(), "--refusal-threshold", "1"});
    int code = -1;
    ASSERT_TRUE(witness.Until([&] { return (code = executive.Wait(0)) >= 0; }, 60000));
    ASSERT_EQ(code, 3) << deployment.folder;
    const auto search = deployment.Result().at("searches").at(0);
    EXPECT_TRUE(search.at("converged"));
    EXPECT_EQ(search.at("workers"), kWorkers);
    EXPECT_EQ(search.at("evaluations"), observer.evaluated());
    EXPECT_TRUE(witness.Until(
        [&] { return RolloutsTold(witness) == search.at("rollouts").get<std::int64_t>(); }, 3000))
        << RolloutsTold(witness) << " made, " << search.at("rollouts") << " counted";
    CheckApartAndStruck(witness);
  }

  void CheckApartAndStruck(const Witness& witness) {
    for (const auto& worker : witness.Services("worker")) {
      EXPECT_NE(NetworkOf(std::to_string(worker.pid)), NetworkOf("self"));
      EXPECT_GT(Counter(worker, "chaos: dropped"), 0);
      EXPECT_GT(Counter(worker, "chaos: delayed"), 0);
    }
  }

 private:
  static int seed_;
  std::list<Process> workers_;
};

int Hosts::seed_ = 0;

TEST_F(Hosts, SearchTogetherWithExactCounts) { SearchAndCount("hosts_multicast"); }

// For networks without multicast: LCM's own relay, from the package liblcm-java.
TEST_F(Hosts, SearchTogetherThroughTheTcpRelay) {
  const std::string folder = MakeFolder("hosts_relay_log");
  Process relay("/usr/bin/java", {"-cp", PROSPECT_LCM_JAR, "lcm.lcm.TCPService", kRelayPort},
                folder + "/relay.log");
  const std::string url = std::string("tcpq://10.77.0.1:") + kRelayPort;
  setenv("LCM_DEFAULT_URL", url.c_str(), 1);
  ASSERT_TRUE(PortOpens("10.77.0.1", std::atoi(kRelayPort), 20000))
      << ReadText(folder + "/relay.log");
  SearchAndCount("hosts_relay");
}

}  // namespace
}  // namespace prospect::tests
