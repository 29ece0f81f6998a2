#include "base/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <sys/wait.h>

#include <thread>

#include "base/lock.h"
#include "tests/unit/base/folder.h"

namespace prospect::base {
namespace {

namespace fs = std::filesystem;
using AtomicFileTest = InFolder;

mode_t ModeOf(const std::string& path) {
  struct stat info {};
  return ::lstat(path.c_str(), &info) == 0 ? info.st_mode : 0;
}

std::string WordsOf(const std::function<void()>& write) {
  try {
    write();
  } catch (const DiskError& error) {
    return error.what();
  }
  return "no error";
}

TEST_F(AtomicFileTest, IsThereWholeOrNotAtAll) {
  {
    AtomicFile file(Path("a.txt"));
    file.Write("half");
    EXPECT_FALSE(fs::exists(Path("a.txt")));
    EXPECT_EQ(fs::path(file.temporary()).extension(), ".txt") << "libraries write by the ending";
  }
  EXPECT_EQ(Files(), 0u) << "without Commit() nothing remains";
  WriteFile(Path("a.txt"), "first");
  WriteFile(Path("a.txt"), "second");
  EXPECT_EQ(Read(Path("a.txt")), "second");
  EXPECT_EQ(Files(), 1u);
}

TEST_F(AtomicFileTest, KeepsTheModeOfWhatItReplaces) {
  WriteFile(Path("a"), "first");
  const mode_t mask = ::umask(022);
  ::umask(mask);
  EXPECT_EQ(ModeOf(Path("a")) & 0777, 0666 & ~mask);
  ::chmod(Path("a").c_str(), 0640);
  WriteFile(Path("a"), "second");
  EXPECT_EQ(ModeOf(Path("a")) & 07777, 0640u);
}

TEST_F(AtomicFileTest, FollowsALinkToItsTarget) {
  fs::create_directories(folder_ / "elsewhere");
  WriteFile(Path("elsewhere/target"), "old");
  fs::create_symlink("elsewhere/target", folder_ / "link");
  WriteFile(Path("link"), "new");
  EXPECT_TRUE(fs::is_symlink(Path("link")));
  EXPECT_EQ(Read(Path("elsewhere/target")), "new");
  fs::create_symlink("elsewhere/not-yet", folder_ / "dangling");
  WriteFile(Path("dangling"), "made");
  EXPECT_TRUE(fs::is_symlink(Path("dangling")));
  EXPECT_EQ(Read(Path("elsewhere/not-yet")), "made");
}

// As in /tmp: another user's link would lead this one's writing anywhere.
TEST_F(AtomicFileTest, AnothersLinkInAFolderOfEverybodysIsNotFollowed) {
  if (geteuid() != 0) GTEST_SKIP() << "only root can make another user's link";
  const fs::path everybodys = folder_ / "everybodys";
  fs::create_directory(everybodys);
  ASSERT_EQ(chmod(everybodys.c_str(), 01777), 0);
  WriteFile(Path("victim"), "precious");
  for (const char* name : {"theirs", "ours"}) fs::create_symlink(Path("victim"), everybodys / name);
  ASSERT_EQ(lchown((everybodys / "theirs").c_str(), 65534, 65534), 0);
  EXPECT_THROW(WriteFile((everybodys / "theirs").string(), "x"), DiskError);
  EXPECT_EQ(Read(Path("victim")), "precious");
  WriteFile((everybodys / "ours").string(), "new");
  EXPECT_EQ(Read(Path("victim")), "new");
}

// Whatever others have put under the names it would use, it finds one.
TEST_F(AtomicFileTest, AFolderUnderItsOtherNameDoesNotStopIt) {
  const std::string other = [&] { return AtomicFile(Path("a")).temporary(); }();
  fs::create_directory(other);
  WriteFile(Path("a"), "text");
  EXPECT_EQ(Read(Path("a")), "text");
}

TEST_F(AtomicFileTest, LinksInACircleAreAnError) {
  fs::create_symlink("b", folder_ / "a");
  fs::create_symlink("a", folder_ / "b");
  EXPECT_NE(WordsOf([&] { WriteFile(Path("a"), "x"); }).find("levels of symbolic links"),
            std::string::npos);
}

TEST_F(AtomicFileTest, WritesIntoAPipeAndLeavesIt) {
  ASSERT_EQ(::mkfifo(Path("pipe").c_str(), 0600), 0);
  for (const bool by_library : {false, true}) {
    std::string heard;
    std::thread reader([&] { heard = Read(Path("pipe")); });
    if (by_library) {
      AtomicFile file(Path("pipe"));
      std::ofstream(file.temporary()) << "to a pipe";
      file.Commit();
    } else {
      WriteFile(Path("pipe"), "to a pipe");
    }
    reader.join();
    EXPECT_EQ(heard, "to a pipe");
    EXPECT_TRUE(S_ISFIFO(ModeOf(Path("pipe"))));
  }
  EXPECT_EQ(Files(), 1u);
}

TEST_F(AtomicFileTest, WritesIntoADeviceAndLeavesIt) {
  if (::mknod(Path("null").c_str(), S_IFCHR | 0666, makedev(1, 3)) != 0)
    GTEST_SKIP() << "no device may be made here";
  WriteFile(Path("null"), "gone");
  EXPECT_TRUE(S_ISCHR(ModeOf(Path("null"))));
}

TEST_F(AtomicFileTest, AFullDeviceIsSaidAndStaysOne) {
  if (::mknod(Path("full").c_str(), S_IFCHR | 0666, makedev(1, 7)) != 0)
    GTEST_SKIP() << "no device may be made here";
  const std::string words = WordsOf([&] { WriteFile(Path("full"), "x"); });
  EXPECT_NE(words.find("No space left on device"), std::string::npos) << words;
  EXPECT_TRUE(S_ISCHR(ModeOf(Path("full"))));
}

// As a shell's `--json /dev/stdout >file`: what was printed before stays, and the file is the same.
TEST_F(AtomicFileTest, WritesBehindWhatThisProcessHasWritten) {
  const int file = ::open(Path("out").c_str(), O_WRONLY | O_CREAT, 0644);
  ASSERT_EQ(::write(file, "before ", 7), 7);
  WriteFile("/proc/self/fd/" + std::to_string(file), "and after");
  ::close(file);
  EXPECT_EQ(Read(Path("out")), "before and after");
}

TEST_F(AtomicFileTest, NamesFileAndReason) {
  EXPECT_EQ(WordsOf([&] { WriteFile(Path("no/folder"), "x"); }),
            Path("no/folder") +
                ": cannot be written (No such file or directory); check the folder and the space "
                "on the disk");
  EXPECT_NE(WordsOf([&] { WriteFile(folder_.string(), "x"); }).find("Is a directory"),
            std::string::npos);
}

TEST_F(AtomicFileTest, TwoWritersDoNotMixAndTheLastOneCounts) {
  AtomicFile first(Path("a")), second(Path("a"));
  EXPECT_NE(first.temporary(), second.temporary());
  first.Write("first");
  second.Write("second");
  first.Commit();
  EXPECT_EQ(Read(Path("a")), "first");
  second.Commit();
  EXPECT_EQ(Read(Path("a")), "second");
}

TEST_F(AtomicFileTest, ARivalIsRefusedWhereAskedFor) {
  const AtomicFile first(Path("a"));
  EXPECT_NE(
      WordsOf([&] { AtomicFile(Path("a"), Rivals::kRefused); }).find("is in use by base_test"),
      std::string::npos);
}

TEST_F(AtomicFileTest, WhatAKilledWriterLeftIsUsedAgain) {
  const pid_t child = fork();
  if (child == 0) {
    AtomicFile file(Path("a"));
    file.Write("half of what a killed writer had to say");
    _exit(0);  // no destructor
  }
  ::waitpid(child, nullptr, 0);
  EXPECT_EQ(Files(), 1u);
  WriteFile(Path("a"), "whole");
  EXPECT_EQ(Read(Path("a")), "whole");
  EXPECT_EQ(Files(), 1u);
}

// Somebody else's file or link under the other name is neither written to nor given the name.
TEST_F(AtomicFileTest, WhatStandsUnderTheOtherNameIsLeftAlone) {
  const std::string other = [&] { return AtomicFile(Path("a")).temporary(); }();
  WriteFile(Path("victim"), "mine");
  fs::create_symlink(Path("victim"), other);
  WriteFile(Path("a"), "whole");
  EXPECT_EQ(Read(Path("victim")), "mine");
  EXPECT_EQ(Read(Path("a")), "whole");
  EXPECT_FALSE(fs::is_symlink(Path("a")));
}

}  // namespace
}  // namespace prospect::base
