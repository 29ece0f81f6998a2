// Who may be trusted with a deployment's state, and how its supervisor is told from strangers.

#include "services/supervisor/state_folder.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <regex>

#include "base/exit_error.h"

namespace prospect::services {
namespace {

namespace fs = std::filesystem;
using IfAbsent = StateFolder::IfAbsent;

mode_t ModeOf(const std::string& path) {
  struct stat found {};
  return stat(path.c_str(), &found) == 0 ? found.st_mode & 07777 : 0;
}

std::string ReadText(const std::string& path) {
  std::ifstream in(path);
  return {std::istreambuf_iterator<char>(in), {}};
}

class StateFolders : public testing::Test {
 protected:
  StateFolders() {
    std::string name = testing::TempDir() + "state_XXXXXX";
    root = mkdtemp(name.data());
  }
  ~StateFolders() override { fs::remove_all(root); }

  // Expects that it is refused with a line that holds `reason`.
  void ExpectRefused(const std::string& path, const std::string& reason) {
    for (const IfAbsent if_absent : {IfAbsent::kMake, IfAbsent::kAccept}) {
      try {
        StateFolder(path, if_absent);
        FAIL() << path << " was taken";
      } catch (const ExitError& error) {
        EXPECT_EQ(error.code(), kExitDisk);
        const std::string what = error.what();
        EXPECT_NE(what.find(reason), std::string::npos) << what;
        EXPECT_EQ(what.find('\n'), std::string::npos);
      }
    }
  }

  std::string root;
};

// A process that does `body` and then stays until it is killed.
class Other {
 public:
  explicit Other(const std::function<void()>& body) {
    int ends[2];
    if (pipe(ends) != 0) abort();
    pid = fork();
    if (pid == 0) {
      body();
      if (write(ends[1], "", 1) != 1) _exit(1);
      while (true) pause();
    }
    char byte = 0;
    if (read(ends[0], &byte, 1) != 1) abort();
    close(ends[0]);
    close(ends[1]);
  }
  ~Other() { End(); }
  void End() {
    if (pid <= 0) return;
    kill(pid, SIGKILL);
    waitpid(pid, nullptr, 0);
    pid = -1;
  }
  pid_t pid = -1;
};

TEST_F(StateFolders, AreMadeForTheirOwnerAlone) {
  const StateFolder state(root + "/prospect/bus", IfAbsent::kMake);
  EXPECT_TRUE(state.exists());
  EXPECT_EQ(ModeOf(root + "/prospect"), 0700u);
  EXPECT_EQ(ModeOf(root + "/prospect/bus"), 0700u);
}

TEST_F(StateFolders, ThatNobodyMadeAreNotMadeByAsking) {
  const StateFolder state(root + "/prospect/bus", IfAbsent::kAccept);
  EXPECT_FALSE(state.exists());
  EXPECT_EQ(state.Holder(), StateFolder::kNobody);
  EXPECT_FALSE(fs::exists(root + "/prospect"));
}

TEST_F(StateFolders, OfOurOwnThatOthersCouldReadAreShut) {
  fs::create_directories(root + "/prospect/bus");
  chmod((root + "/prospect/bus").c_str(), 0755);
  StateFolder(root + "/prospect/bus", IfAbsent::kMake);
  EXPECT_EQ(ModeOf(root + "/prospect/bus"), 0700u);
}

TEST_F(StateFolders, ThatAreLinksAreRefused) {
  fs::create_directories(root + "/elsewhere/bus");
  fs::create_directory_symlink(root + "/elsewhere", root + "/prospect");
  ExpectRefused(root + "/prospect/bus", root + "/prospect: it is a link");
  fs::remove(root + "/prospect");
  fs::create_directory(root + "/prospect");
  fs::create_directory_symlink(root + "/elsewhere/bus", root + "/prospect/bus");
  ExpectRefused(root + "/prospect/bus", root + "/prospect/bus: it is a link");
  EXPECT_TRUE(fs::is_empty(root + "/elsewhere/bus"));
}

TEST_F(StateFolders, ThatAreFilesAreRefused) {
  fs::create_directories(root + "/prospect");
  std::ofstream(root + "/prospect/bus") << "a file";
  ExpectRefused(root + "/prospect/bus", "no folder");
}

TEST_F(StateFolders, ThatOthersMayWriteToAreRefused) {
  fs::create_directories(root + "/prospect/bus");
  chmod((root + "/prospect/bus").c_str(), 0770);
  ExpectRefused(root + "/prospect/bus", "others may write");
  chmod((root + "/prospect/bus").c_str(), 0700);
  chmod((root + "/prospect").c_str(), 0707);
  ExpectRefused(root + "/prospect/bus", "others may write");
}

TEST_F(StateFolders, OfOtherUsersAreRefused) {
  fs::create_directories(root + "/prospect/bus");
  if (chown((root + "/prospect/bus").c_str(), 4711, 4711) != 0) GTEST_SKIP() << "needs root";
  ExpectRefused(root + "/prospect/bus", "belongs to user 4711");
  ASSERT_EQ(chown((root + "/prospect/bus").c_str(), geteuid(), getegid()), 0);
  ASSERT_EQ(chown((root + "/prospect").c_str(), 4711, 4711), 0);
  ExpectRefused(root + "/prospect/bus", "belongs to user 4711");
}

// Who only asks changes nothing, and a folder where no supervisor was holds nothing of ours.
TEST_F(StateFolders, AnothersFolderIsLeftAsItIs) {
  const std::string theirs = root + "/theirs.d";
  fs::create_directory(theirs);
  fs::permissions(theirs, fs::perms(0755));
  const StateFolder asked(theirs, IfAbsent::kAccept);
  EXPECT_FALSE(asked.was_used());
  EXPECT_EQ(fs::status(theirs).permissions(), fs::perms(0755));
  StateFolder taken(theirs, IfAbsent::kMake);
  EXPECT_TRUE(taken.Lock());
  EXPECT_TRUE(taken.was_used());
}

TEST_F(StateFolders, ALockThatIsALinkIsNotFollowed) {
  StateFolder state(root + "/prospect/bus", IfAbsent::kMake);
  std::ofstream(root + "/theirs") << "precious";
  fs::create_symlink(root + "/theirs", state.path() + "/prospect-supervisor.lock");
  EXPECT_THROW(state.Lock(), ExitError);
  EXPECT_EQ(ReadText(root + "/theirs"), "precious");
}

TEST_F(StateFolders, TheKernelSaysWhoHoldsTheLockAndItDiesWithTheHolder) {
  StateFolder ours(root + "/prospect/bus", IfAbsent::kMake);
  EXPECT_EQ(ours.Holder(), StateFolder::kNobody);
  Other other([&] {
    static StateFolder theirs(root + "/prospect/bus", IfAbsent::kMake);
    if (!theirs.Lock()) _exit(1);
  });
  EXPECT_EQ(ours.Holder(), other.pid);
  EXPECT_FALSE(ours.Lock());
  EXPECT_EQ(ours.Holder(), other.pid) << "asking does not harm it";
  other.End();
  EXPECT_EQ(ours.Holder(), StateFolder::kNobody);
  EXPECT_TRUE(ours.Lock());
  EXPECT_EQ(ours.Holder(), getpid());
}

TEST_F(StateFolders, ChildrenDoNotHoldTheLock) {
  auto ours = std::make_unique<StateFolder>(root + "/prospect/bus", IfAbsent::kMake);
  ASSERT_TRUE(ours->Lock());
  const Other child([] {});
  ours.reset();
  EXPECT_EQ(StateFolder(root + "/prospect/bus", IfAbsent::kAccept).Holder(), StateFolder::kNobody);
}

TEST_F(StateFolders, KeysAreRandomAndTheirOwnersAlone) {
  const StateFolder state(root + "/prospect/bus", IfAbsent::kMake);
  const std::string path = state.MakeKey();
  EXPECT_EQ(ModeOf(path), 0600u);
  const std::string first = ReadText(path);
  EXPECT_TRUE(std::regex_match(first, std::regex("[0-9a-f]{64}\n"))) << first;
  state.MakeKey();
  EXPECT_NE(ReadText(path), first);
}

TEST_F(StateFolders, AreClearedByWhoHeldTheLock) {
  const std::string path = root + "/prospect/bus";
  {
    StateFolder state(path, IfAbsent::kMake);
    ASSERT_TRUE(state.Lock());
    state.MakeKey();
    const StateFolder looker(path, IfAbsent::kAccept);
  }
  EXPECT_FALSE(fs::exists(path + "/key"));
}

class StateFolderNames : public StateFolders {
 protected:
  StateFolderNames() { setenv("XDG_RUNTIME_DIR", root.c_str(), 1); }
  ~StateFolderNames() override { unsetenv("XDG_RUNTIME_DIR"); }
};

TEST_F(StateFolderNames, FollowTheBusAndNotItsParameters) {
  const std::string folder = StateFolderOf("udpm://239.255.76.67:7667?ttl=0");
  EXPECT_EQ(folder, root + "/prospect/239.255.76.67_7667");
  EXPECT_EQ(StateFolderOf("udpm://239.255.76.67:7667?recv_buf_size=65536&ttl=1"), folder);
  EXPECT_NE(StateFolderOf("udpm://239.255.76.67:7668?ttl=0"), folder);
  EXPECT_NE(StateFolderOf("tcpq://239.255.76.67:7667"), folder);
  EXPECT_EQ(fs::path(StateFolderOf("file://../../x")).parent_path(), root + "/prospect");
}

TEST_F(StateFolderNames, LieNotInARuntimeFolderOfSomebodyElse) {
  if (chown(root.c_str(), 4711, 4711) != 0) GTEST_SKIP() << "needs root";
  EXPECT_NE(StateFolderOf("").rfind(root, 0), 0u);
  ASSERT_EQ(chown(root.c_str(), geteuid(), getegid()), 0);
}

TEST_F(StateFolderNames, PrivateOnesAreNew) {
  const std::string first = MakePrivateFolder();
  EXPECT_NE(first, MakePrivateFolder());
  EXPECT_EQ(ModeOf(first), 0700u);
  StateFolder(first, IfAbsent::kAccept).Remove();
  EXPECT_FALSE(fs::exists(first));
}

}  // namespace
}  // namespace prospect::services
