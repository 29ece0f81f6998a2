#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <set>

#include "base/json_file.h"
#include "cli/options/bus.h"
#include "services/common/bus_url.h"
#include "services/common/channels.h"
#include "services/common/clock.h"
#include "services/common/ids.h"
#include "services/common/log.h"
#include "services/common/signals.h"

namespace prospect::services {
namespace {

TEST(Ids, ArePositiveAndDiffer) {
  std::set<std::int64_t> ids;
  for (int i = 0; i < 1000; ++i) {
    ids.insert(RandomId());
    EXPECT_GT(*ids.begin(), 0);
  }
  EXPECT_EQ(ids.size(), 1000u);
}

TEST(Ids, DeploymentComesFromTheEnvironmentUntilSet) {
  unsetenv("PROSPECT_DEPLOYMENT");
  EXPECT_EQ(DeploymentId(), 0);
  setenv("PROSPECT_DEPLOYMENT", "9223372036854775807", 1);
  EXPECT_EQ(DeploymentId(), INT64_MAX);
  for (const char* bad : {"x", "-1", "0", "12x", "9223372036854775808"}) {
    setenv("PROSPECT_DEPLOYMENT", bad, 1);
    EXPECT_THROW(DeploymentId(), std::runtime_error) << bad;
  }
  SetDeploymentId(5);
  EXPECT_EQ(DeploymentId(), 5);
}

TEST(Periodic, IsDueAtOnceThenOncePerPeriod) {
  Periodic periodic(100);
  EXPECT_EQ(periodic.Remaining(1000), 0);
  EXPECT_TRUE(periodic.Due(1000));
  EXPECT_FALSE(periodic.Due(1099));
  EXPECT_EQ(periodic.Remaining(1060), 40);
  EXPECT_TRUE(periodic.Due(1100));
  EXPECT_TRUE(periodic.Due(5000));
  EXPECT_FALSE(periodic.Due(5001));  // missed periods are not made up for
  periodic.Hurry();
  EXPECT_TRUE(periodic.Due(5002));
}

TEST(BusUrl, OptionBeforeEnvironmentBeforeDefault) {
  setenv("LCM_DEFAULT_URL", "memq://", 1);
  EXPECT_EQ(ResolveBusUrl("tcpq://host:1"), "tcpq://host:1");
  EXPECT_EQ(ResolveBusUrl(""), "memq://");
  setenv("LCM_DEFAULT_URL", "", 1);
  EXPECT_EQ(ResolveBusUrl(""), prospect::cli::kDefaultBusUrl);
  unsetenv("LCM_DEFAULT_URL");
  EXPECT_EQ(ResolveBusUrl(""), prospect::cli::kDefaultBusUrl);
}

TEST(BusUrl, UdpGetsAReceiveBuffer) {
  EXPECT_EQ(ResolveBusUrl("udpm://239.255.76.67:7668"),
            "udpm://239.255.76.67:7668?recv_buf_size=4194304");
  EXPECT_EQ(ResolveBusUrl("udpm://?ttl=1"), "udpm://?ttl=1&recv_buf_size=4194304");
  EXPECT_EQ(ResolveBusUrl("udpm://?recv_buf_size=1000"), "udpm://?recv_buf_size=1000");
}

TEST(BusUrl, AdviceNamesTheCommand) {
  EXPECT_NE(BusAdvice(prospect::cli::kDefaultBusUrl).find("ip route add 224.0.0.0/4 dev lo"),
            std::string::npos);
  EXPECT_NE(BusAdvice("foo://").find("udpm://"), std::string::npos);
  EXPECT_EQ(ReceiveBufferWarning("memq://"), "");
  if (ReceiveBufferLimit() > 0) {
    EXPECT_NE(ReceiveBufferWarning("udpm://?recv_buf_size=999999999999").find("rmem_max"),
              std::string::npos);
  }
}

TEST(Channels, AreSortedAndCarryOneTypeEach) {
  std::set<std::string> types;
  std::string previous;
  for (const ChannelInfo& channel : Channels()) {
    EXPECT_LT(previous, channel.name);
    EXPECT_TRUE(types.insert(channel.type_name).second) << channel.type_name;
    EXPECT_GE(channel.queue_capacity, 30);
    previous = channel.name;
  }
  EXPECT_STREQ(FindChannel("LABEL")->type_name, "label_t");
  EXPECT_EQ(FindChannel("label"), nullptr);
}

TEST(Log, RefusesUnknownLevels) {
  EXPECT_THROW(SetUpLog("test", "loud"), std::runtime_error);
  EXPECT_NO_THROW(SetUpLog("test", "off"));
}

TEST(JsonFile, IsWholeOrAnErrorOfTheDisk) {
  const std::string path = testing::TempDir() + "/json_file_test.json";
  base::WriteJsonFile(path, {{"a", 1}});
  nlohmann::json read;
  std::ifstream(path) >> read;
  EXPECT_EQ(read["a"], 1);
  EXPECT_THROW(base::WriteJsonFile("/nonexistent/folder/x.json", {}), base::DiskError);
}

TEST(Signals, RaiseAFlagOnce) {
  InstallStopSignals();
  EXPECT_FALSE(StopRequested());
  std::raise(SIGTERM);
  EXPECT_TRUE(StopRequested());
}

}  // namespace
}  // namespace prospect::services
