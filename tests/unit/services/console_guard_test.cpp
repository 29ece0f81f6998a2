// Who is let in by the console, and what it makes of what a page sends.

#include <gtest/gtest.h>

#include "planner/goal.h"
#include "services/console/episode_starter.h"
#include "services/console/page_values.h"
#include "services/console/request_guard.h"

namespace prospect::services::console {
namespace {

using nlohmann::json;

TEST(RequestGuard, HostsAreAddressesOrThisMachineWithThePort) {
  const RequestGuard guard(7660, "");
  for (const char* host :
       {"127.0.0.1:7660", "localhost:7660", "LOCALHOST:7660", "[::1]:7660", "10.1.2.3:7660"})
    EXPECT_TRUE(guard.HostAllowed(host)) << host;
  for (const char* host : {"", "localhost", "evil.example:7660", "127.0.0.1.evil.example:7660",
                           "127.0.0.1:7661", "127.0.0.1:17660x:7660", "[evil]:7660"})
    EXPECT_FALSE(guard.HostAllowed(host)) << host;
}

TEST(RequestGuard, OriginsAreThisVeryServer) {
  const RequestGuard guard(7660, "");
  EXPECT_TRUE(guard.OriginAllowed("http://localhost:7660", "localhost:7660", true));
  EXPECT_TRUE(guard.OriginAllowed("", "localhost:7660", false));
  EXPECT_FALSE(guard.OriginAllowed("", "localhost:7660", true));
  EXPECT_FALSE(guard.OriginAllowed("null", "localhost:7660", false));
  EXPECT_FALSE(guard.OriginAllowed("http://evil.example", "localhost:7660", false));
  EXPECT_FALSE(guard.OriginAllowed("https://localhost:7660", "localhost:7660", true));
}

TEST(RequestGuard, TokensMustBeWholeAndRight) {
  EXPECT_TRUE(RequestGuard(1, "").TokenRight("whatever"));
  const RequestGuard guard(1, "0123");
  EXPECT_TRUE(guard.TokenRight("0123"));
  for (const char* token : {"", "012", "01234", "0124"}) EXPECT_FALSE(guard.TokenRight(token));
  EXPECT_EQ(QueryValue("/live?token=0123&x=1", "token"), "0123");
  EXPECT_EQ(QueryValue("/live?tokens=0123", "token"), "");
  EXPECT_EQ(QueryValue("/live", "token"), "");
  EXPECT_NE(MakeToken(), MakeToken());
}

TEST(PageValues, PathsAndIdsAreWhatTheySay) {
  EXPECT_EQ(PathFrom(json::parse("[0, 254]")), (planner::Path{0, 254}));
  for (const char* text : {"[255]", "[-1]", "[1.5]", "[\"1\"]", "{}", "null", "[[]]"})
    EXPECT_ANY_THROW(PathFrom(json::parse(text))) << text;
  EXPECT_ANY_THROW(PathFrom(json(std::vector<int>(33, 0))));
  EXPECT_EQ(IdFrom("9223372036854775807"), 9223372036854775807);
  for (const char* text : {"\"\"", "\"-1\"", "\"12345678901234567890\"", "12", "null"})
    EXPECT_ANY_THROW(IdFrom(json::parse(text))) << text;
}

TEST(RunArguments, AreCheckedOneByOne) {
  const json good = {{"seed", 5},
                     {"samples", 30},
                     {"retries", 1},
                     {"goal", "on(red,blue)"},
                     {"threshold", nullptr}};
  const auto words = RunArguments(good);
  EXPECT_EQ(words, (std::vector<std::string>{"--seed", "5", "--samples", "30", "--retries", "1",
                                             "--goal=on(red,blue)"}));
  for (const auto& [name, value] :
       std::vector<std::pair<std::string, json>>{{"seed", -1},
                                                 {"seed", "5"},
                                                 {"samples", 0},
                                                 {"retries", 1e9},
                                                 {"threshold", 1.5},
                                                 {"goal", "--help ("}}) {
    json bad = good;
    bad[name] = value;
    EXPECT_ANY_THROW(RunArguments(bad)) << name << " " << value;
  }
}

}  // namespace
}  // namespace prospect::services::console
