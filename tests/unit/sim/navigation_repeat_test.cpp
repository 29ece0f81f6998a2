// The same seeds and calls give the same bits: within a process, in another one, in other threads,
// next to other tasks, and after Restore.

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <stdexcept>
#include <thread>

#include "base/hash.h"
#include "base/random.h"
#include "sim/navigation/navigation_task.h"
#include "sim/rollout.h"

namespace prospect::sim {
namespace {

// Hashes every frame, robot state and verdict.
class HashSink : public FrameSink {
 public:
  explicit HashSink(const Task& task) : task_(task) {}

  void OnFrame(const Image& image, const Progress& progress) override {
    const std::vector<double> state = task_.RobotState();
    hash_ = base::HashBytes(image.rgb.data(), image.rgb.size(), hash_);
    hash_ = base::HashBytes(state.data(), state.size() * sizeof(double), hash_);
    hash_ = base::HashBytes(progress.reason.data(), progress.reason.size(), hash_);
    ++frames_;
  }

  std::uint64_t hash() const { return hash_; }
  int frames() const { return frames_; }

 private:
  const Task& task_;
  std::uint64_t hash_ = 0xcbf29ce484222325ULL;
  int frames_ = 0;
};

// A whole random trial.
std::uint64_t TrialHash(Task& task, std::uint64_t seed) {
  task.Reset(seed);
  HashSink sink(task);
  base::Random random(seed);
  sink.OnFrame(task.Observe(), task.progress());
  for (std::vector<int> legal = task.LegalActions(); !legal.empty(); legal = task.LegalActions()) {
    RunAction(task, legal[random.Below(static_cast<int>(legal.size()))], &sink);
  }
  EXPECT_GT(sink.frames(), 10);
  return sink.hash();
}

TEST(NavigationRepeats, WithTheSameSeed) {
  NavigationTask task(TaskOptions{});
  const std::uint64_t first = TrialHash(task, 11);
  EXPECT_NE(first, TrialHash(task, 12));
  EXPECT_EQ(first, TrialHash(task, 11));  // another trial in between leaves no trace
  NavigationTask fresh(TaskOptions{});
  EXPECT_EQ(first, TrialHash(fresh, 11));
}

TEST(NavigationRepeats, InAnotherProcess) {
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    NavigationTask task(TaskOptions{});
    const std::uint64_t hash = TrialHash(task, 21);
    _exit(write(ends[1], &hash, sizeof hash) == sizeof hash ? 0 : 1);
  }
  std::uint64_t hash = 0;
  ASSERT_EQ(read(ends[0], &hash, sizeof hash), static_cast<ssize_t>(sizeof hash));
  int status = 0;
  waitpid(child, &status, 0);
  NavigationTask task(TaskOptions{});
  EXPECT_EQ(hash, TrialHash(task, 21));
}

TEST(NavigationRepeats, WhenTwoTasksTakeTurns) {
  const TaskOptions seven{7, 5};
  NavigationTask a(TaskOptions{}), b(seven), alone(TaskOptions{});
  const auto step = [](Task& task) {
    if (task.progress().action_state != ActionState::kRunning && !task.LegalActions().empty()) {
      task.StartAction(task.LegalActions().back());
    }
    task.Tick();
  };
  a.Reset(31);
  b.Reset(32);
  alone.Reset(31);
  for (int i = 0; i < 150; ++i) {
    step(a);
    step(b);
  }
  for (int i = 0; i < 150; ++i) step(alone);
  EXPECT_EQ(a.RobotState(), alone.RobotState());
  EXPECT_EQ(a.Observe().rgb, alone.Observe().rgb);
}

TEST(NavigationRepeats, InTwoThreadsAtOnce) {
  std::uint64_t hashes[2] = {0, 1};
  std::vector<std::thread> threads;
  for (std::uint64_t& hash : hashes) {
    threads.emplace_back([&hash] {
      NavigationTask task(TaskOptions{});
      hash = TrialHash(task, 41);
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(hashes[0], hashes[1]);
}

TEST(NavigationRepeats, AfterRestoreInTheMiddleOfALeg) {
  NavigationTask task(TaskOptions{});
  task.Reset(51);
  task.StartAction(2);
  for (int i = 0; i < 13; ++i) task.Tick();
  const std::unique_ptr<TaskState> state = task.Save();
  const auto rest = [](Task& t) {
    HashSink sink(t);
    for (int i = 0; i < 60; ++i) {
      t.Tick();
      sink.OnFrame(t.Observe(), t.progress());
    }
    return sink.hash();
  };
  const std::uint64_t first = rest(task);
  task.Restore(*state);
  EXPECT_EQ(first, rest(task));
  NavigationTask other(TaskOptions{});  // another object with another scene
  other.Reset(52);
  other.Observe();
  other.Restore(*state);
  EXPECT_EQ(first, rest(other));
}

TEST(NavigationRepeats, RefusesStatesOfOtherOptions) {
  NavigationTask four({4, 3}), seven({7, 3});
  EXPECT_THROW(seven.Restore(*four.Save()), std::invalid_argument);
  struct Foreign : TaskState {};
  EXPECT_THROW(four.Restore(Foreign()), std::invalid_argument);
}

// Plans with one beginning see one run of it under one noise seed; other seeds give other runs.
TEST(NavigationRepeats, NoiseIsAFunctionOfSeedAndPath) {
  NavigationTask task(TaskOptions{});
  task.Reset(3);
  const std::unique_ptr<TaskState> start = task.Save();
  const auto after = [&](std::uint64_t noise, const std::vector<int>& plan) {
    task.Restore(*start);
    task.SetNoiseSeed(noise);
    RunPlan(task, plan, nullptr);
    return task.RobotState();
  };
  const std::vector<double> once = after(7, {0, 1});
  after(8, {2});
  EXPECT_EQ(once, after(7, {0, 1}));
  EXPECT_NE(after(7, {0}), after(8, {0}));
}

}  // namespace
}  // namespace prospect::sim
