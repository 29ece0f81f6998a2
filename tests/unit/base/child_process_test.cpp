#include "base/child_process.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>

#include "base/disk_error.h"

namespace prospect::base {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kLong{20000};
constexpr milliseconds kShort{100};

ChildOptions Shell(const std::string& script) {
  ChildOptions options;
  options.command = {"/bin/sh", "-c", script};
  return options;
}

bool IsThere(int pid) { return kill(pid, 0) == 0; }

// Whether it is gone before a deadline.
bool Goes(int pid) {
  for (int i = 0; i < 2000 && IsThere(pid); ++i) usleep(10'000);
  return !IsThere(pid);
}

TEST(ChildProcess, SaysHowItEndedAsAShellDoes) {
  EXPECT_EQ(ChildProcess(Shell("exit 7")).Wait(), 7);
  EXPECT_EQ(ChildProcess(Shell("kill -TERM $$")).Wait(), 128 + SIGTERM);
  ChildOptions nowhere;
  nowhere.command = {"/no/such/program"};
  EXPECT_EQ(ChildProcess(nowhere).Wait(), 127);
  EXPECT_THROW(ChildProcess{ChildOptions()}, std::runtime_error);
}

TEST(ChildProcess, WaitsNoLongerThanToldTo) {
  ChildProcess child(Shell("exec sleep 600"));
  EXPECT_EQ(child.Wait(kShort), std::nullopt);
  EXPECT_TRUE(child.Running());
  EXPECT_EQ(child.End(kLong), 128 + SIGTERM);
  EXPECT_FALSE(child.Running());
  EXPECT_EQ(child.pid(), -1);
  EXPECT_EQ(child.Status(), 128 + SIGTERM) << "still known";
}

TEST(ChildProcess, WhatHeedsNoTermIsKilled) {
  // It says when it is deaf, so that the signal does not come too soon.
  const std::string said = testing::TempDir() + "/deaf-" + std::to_string(getpid());
  ChildProcess child(Shell("trap '' TERM; : >'" + said + "'; while :; do sleep 0.01; done"));
  while (!std::ifstream(said)) usleep(1000);
  EXPECT_EQ(child.End(kShort), 128 + SIGKILL);
  std::remove(said.c_str());
}

TEST(ChildProcess, EndsWithItsObject) {
  int pid = -1;
  {
    const ChildProcess child(Shell("exec sleep 600"));
    pid = child.pid();
    EXPECT_TRUE(IsThere(pid));
  }
  EXPECT_FALSE(IsThere(pid));
}

TEST(ChildProcess, EndsWithItsParentHoweverThatEnds) {
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  ChildProcess middle([&] {
    const ChildProcess child(Shell("exec sleep 600"));
    const int pid = child.pid();
    if (write(ends[1], &pid, sizeof pid) != sizeof pid) return 1;
    pause();
    return 0;
  });
  int pid = -1;
  ASSERT_EQ(read(ends[0], &pid, sizeof pid), static_cast<ssize_t>(sizeof pid));
  middle.Signal(SIGKILL);
  EXPECT_EQ(middle.Wait(), 128 + SIGKILL);
  EXPECT_TRUE(Goes(pid));
  close(ends[0]);
  close(ends[1]);
}

TEST(ChildProcess, MovesWithItsChild) {
  ChildProcess first(Shell("exec sleep 600"));
  const int pid = first.pid();
  ChildProcess second(std::move(first));
  EXPECT_EQ(second.pid(), pid);
  EXPECT_FALSE(first.Running());  // NOLINT: what is left of it says so
  EXPECT_TRUE(second.Running());
}

TEST(ChildProcess, RunsABodyOfThisProgram) {
  EXPECT_EQ(ChildProcess([] { return 9; }).Wait(kLong), 9);
}

TEST(ChildProcess, HasTheEnvironmentWithItsChanges) {
  setenv("PROSPECT_KEPT", "kept", 1);
  setenv("PROSPECT_CHANGED", "old", 1);
  ChildOptions options = Shell("echo $PROSPECT_KEPT $PROSPECT_CHANGED $PROSPECT_NEW");
  options.environment = {{"PROSPECT_CHANGED", "new"}, {"PROSPECT_NEW", "here"}};
  EXPECT_EQ(RunCaptured(options, kLong).out, "kept new here\n");
}

TEST(ChildProcess, DetachedIsOutOfTheTerminalsReach) {
  ChildOptions options = Shell("read line; echo \"[$line]\"; ps -o sid= -p $$");
  options.detached = true;
  const ChildResult result = RunCaptured(options, kLong);
  EXPECT_EQ(result.out.substr(0, 3), "[]\n");
  EXPECT_NE(std::stoi(result.out.substr(3)), getsid(0));
}

TEST(ChildProcess, SaysHowMuchOfTheProcessorItUsed) {
  ChildProcess child(Shell("while :; do :; done"));
  const auto deadline = std::chrono::steady_clock::now() + kLong;
  while (child.CpuSeconds() == 0 && std::chrono::steady_clock::now() < deadline) usleep(10'000);
  EXPECT_GT(child.CpuSeconds(), 0);
}

TEST(RunCaptured, KeepsWhatIsSaid) {
  const ChildResult result = RunCaptured(Shell("echo out; echo err >&2; exit 4"), kLong);
  EXPECT_EQ(result.status, 4);
  EXPECT_EQ(result.out, "out\n");
  EXPECT_EQ(result.err, "err\n");
}

TEST(RunCaptured, KeepsMoreThanAPipeHolds) {
  const ChildResult result =
      RunCaptured(Shell("head -c 1000000 /dev/zero | tee /dev/stderr"), kLong);
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.out.size(), 1'000'000u);
  EXPECT_EQ(result.err.size(), 1'000'000u);
}

TEST(RunCaptured, WhatTakesTooLongIsEnded) {
  const ChildResult result = RunCaptured(Shell("echo begun; exec sleep 600"), milliseconds(500));
  EXPECT_EQ(result.status, std::nullopt);
  EXPECT_EQ(result.out, "begun\n");
}

TEST(RunCaptured, AGrandchildThatKeepsThePipeDoesNotHoldItUp) {
  const auto began = std::chrono::steady_clock::now();
  const ChildResult result = RunCaptured(Shell("sleep 30 & echo done"), kLong);
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.out, "done\n");
  EXPECT_LT(std::chrono::steady_clock::now() - began, kLong / 2);
}

TEST(OpenOutput, IsAFileOrAnErrorOfTheDisk) {
  EXPECT_THROW(OpenOutput("/no/such/folder/log"), DiskError);
  const std::string path = testing::TempDir() + "/child-" + std::to_string(getpid()) + ".log";
  {
    const Descriptor file = OpenOutput(path);
    ChildOptions options = Shell("echo out; echo err >&2");
    options.out = options.err = file.get();
    EXPECT_EQ(ChildProcess(options).Wait(), 0);
  }
  std::ifstream in(path);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  EXPECT_EQ(text, "out\nerr\n");
  std::remove(path.c_str());
}

TEST(ProgramBeside, LiesWhereThisOneDoes) {
  const std::string path = ProgramBeside("prospect-worker");
  const std::string own = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  EXPECT_EQ(path, own + "/prospect-worker");
}

}  // namespace
}  // namespace prospect::base
