#include "tools/common/causes.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace prospect::tools {
namespace {

TEST(Causes, DropDetails) {
  EXPECT_EQ(CauseOf("obstacle(gripper)"), "obstacle");
  EXPECT_EQ(CauseOf("time"), "time");
  EXPECT_EQ(CauseOf(""), "");
}

TEST(Causes, AddUp) {
  const std::map<std::string, int> causes =
      ByCause({{"obstacle(arm)", 2}, {"obstacle(gripper)", 3}, {"time", 1}});
  EXPECT_EQ(causes, (std::map<std::string, int>{{"obstacle", 5}, {"time", 1}}));
}

TEST(Causes, PrintTheMostFrequentFirstWithWhatIsWithin) {
  char* text = nullptr;
  std::size_t size = 0;
  std::FILE* out = open_memstream(&text, &size);
  PrintCauses({{"time", 1}, {"obstacle(arm)", 2}, {"obstacle(gripper)", 3}}, 10, out);
  std::fclose(out);
  const std::string printed(text);
  std::free(text);
  EXPECT_LT(printed.find("obstacle "), printed.find("obstacle(gripper)"));
  EXPECT_LT(printed.find("obstacle(gripper)"), printed.find("obstacle(arm)"));
  EXPECT_LT(printed.find("obstacle(arm)"), printed.find("time"));
  EXPECT_NE(printed.find("(50.0 %)"), std::string::npos);
}

}  // namespace
}  // namespace prospect::tools
