#include "base/lock.h"

#include <sys/wait.h>

#include "tests/unit/base/folder.h"

namespace prospect::base {
namespace {

using LockTest = InFolder;

std::string WordsOf(const std::string& folder) {
  try {
    const Lock lock = LockFolder(folder);
  } catch (const InUseError& error) {
    return error.what();
  }
  return "";
}

TEST_F(LockTest, TheSecondComerHearsWhoHoldsIt) {
  {
    const Lock first = LockFolder(Path("a/b"));
    EXPECT_EQ(WordsOf(Path("a/b")).rfind(Path("a/b") + ": is in use by base_test", 0), 0u)
        << WordsOf(Path("a/b"));
    EXPECT_NE(WordsOf(Path("a/b")).find("(pid " + std::to_string(::getpid()) + ")"),
              std::string::npos);
    EXPECT_EQ(WordsOf(Path("a")), "");
  }
  EXPECT_EQ(WordsOf(Path("a/b")), "");
  EXPECT_TRUE(std::filesystem::is_empty(Path("a/b"))) << "a lock leaves nothing behind";
}

TEST_F(LockTest, DiesWithItsHolder) {
  int ready[2];
  ASSERT_EQ(::pipe(ready), 0);
  const pid_t child = fork();
  if (child == 0) {
    const Lock lock = LockFolder(Path("a"));
    [[maybe_unused]] const ssize_t told = ::write(ready[1], "x", 1);
    for (;;) ::pause();
  }
  char byte = 0;
  ASSERT_EQ(::read(ready[0], &byte, 1), 1);
  EXPECT_NE(WordsOf(Path("a")).find("(pid " + std::to_string(child) + ")"), std::string::npos);
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  EXPECT_EQ(WordsOf(Path("a")), "");
}

TEST_F(LockTest, AFileInTheWayOfTheFolderIsNamed) {
  std::ofstream(Path("file")) << "x";
  EXPECT_THROW(LockFolder(Path("file/folder")), DiskError);
}

}  // namespace
}  // namespace prospect::base
