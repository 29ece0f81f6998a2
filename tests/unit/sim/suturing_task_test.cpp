#include "sim/suturing/suturing_task.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <stdexcept>
#include <thread>

#include "base/hash.h"
#include "sim/rollout.h"
#include "sim/suturing/gestures.h"
#include "sim/suturing/needle.h"

namespace prospect::sim {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

TaskOptions WithNoise(double noise) {
  TaskOptions options;
  options.execution_noise = noise;
  return options;
}

// One throw after G1.
const std::vector<int> kOneThrow = {kPosition, kPush, kPullLeft, kTransfer};

// Carries all of `plan` out; each gesture must succeed.
void Play(SuturingTask* task, const std::vector<int>& plan) {
  for (int gesture : plan) {
    ASSERT_TRUE(RunAction(*task, gesture, nullptr)) << gesture + 1;
    ASSERT_EQ(task->progress().action_state, ActionState::kSucceeded)
        << gesture + 1 << ' ' << task->progress().reason;
  }
}

class SuturingTaskTest : public testing::Test {
 protected:
  SuturingTaskTest() : task_(WithNoise(0)) { task_.Reset(7); }

  Vector3d Tip() { return task_.world().needle() * NeedlePoint(task_.parameters(), 0); }
  Vector3d Tail() { return task_.world().needle() * NeedlePoint(task_.parameters(), M_PI); }
  Vector3d Right() { return task_.world().hand(kRightHand).translation(); }
  Vector3d Left() { return task_.world().hand(kLeftHand).translation(); }

  SuturingTask task_;
};

TEST_F(SuturingTaskTest, SpecIsThatOfGestures) {
  const TaskSpec& spec = task_.spec();
  EXPECT_EQ(spec.name, "suturing");
  EXPECT_EQ(spec.null_action(), 15);
  EXPECT_EQ(spec.image_width, 128);
  EXPECT_EQ(spec.image_height, 96);
  EXPECT_TRUE(spec.repeats_allowed);
  EXPECT_EQ(spec.plan_length, 18);
  const std::vector<bool> present = task_.PresentActions();
  EXPECT_EQ(std::count(present.begin(), present.end(), true), 10);
  EXPECT_FALSE(present[6]);
}

TEST_F(SuturingTaskTest, StartsWithTheNeedleOnThePad) {
  EXPECT_EQ(task_.world().holder(), kNoHand);
  EXPECT_LT(Tip().z(), 1.5e-3);
  EXPECT_EQ(task_.LegalActions(), (std::vector<int>{kReachRight}));
  EXPECT_EQ(task_.Facts(), (std::vector<std::string>{"throws(0)"}));
}

TEST_F(SuturingTaskTest, ReachTakesTheNeedleAndLiftsIt) {
  Play(&task_, {kReachRight});
  EXPECT_EQ(task_.world().holder(), kRightHand);
  EXPECT_GT(Tip().z(), 5e-3);
  EXPECT_EQ(task_.Facts().front(), "held(needle,right)");
}

TEST_F(SuturingTaskTest, CenterHoldsTheNeedleHighAndTheLeftHandAside) {
  Play(&task_, {kReachRight, kCenter});
  EXPECT_EQ(task_.world().holder(), kRightHand);
  EXPECT_GT(task_.world().needle().translation().z(), 15e-3);
  EXPECT_LT(Left().x(), -15e-3);
}

TEST_F(SuturingTaskTest, PositionSetsTheTipOnItsDot) {
  Play(&task_, {kReachRight, kCenter, kPosition});
  EXPECT_LT((Tip() - EntryDot(task_.parameters(), 0)).norm(), 1e-3);
  EXPECT_EQ(task_.world().holder(), kRightHand);
}

TEST_F(SuturingTaskTest, PushBringsTheTipOutIntoTheLeftHand) {
  Play(&task_, {kReachRight, kCenter, kPosition, kPush});
  EXPECT_EQ(task_.world().holder(), kLeftHand);
  EXPECT_TRUE(task_.suture().in_tissue());
  EXPECT_LT(Tip().x(), ExitDot(task_.parameters(), 0).x());
  EXPECT_GT(Tip().z(), 4e-3);
  EXPECT_GT(Right().x(), 14e-3);  // the right hand has gone
  const SuturingThread::Stitch& stitch = task_.suture().thread.stitches[0];
  EXPECT_LT((stitch.entry - EntryDot(task_.parameters(), 0)).norm(), 1.5e-3);
  EXPECT_LT((stitch.exit - ExitDot(task_.parameters(), 0)).norm(), 1.5e-3);
}

TEST_F(SuturingTaskTest, PullDrawsNeedleAndThreadThrough) {
  Play(&task_, {kReachRight, kCenter, kPosition, kPush, kPullLeft});
  EXPECT_EQ(task_.world().holder(), kLeftHand);
  EXPECT_FALSE(task_.suture().in_tissue());
  EXPECT_EQ(task_.suture().throws(), 1);
  EXPECT_LT(Left().x(), -15e-3);
  const SuturingThread& thread = task_.suture().thread;
  EXPECT_LT(thread.feed, 1e-4);
  EXPECT_NEAR(thread.length, (Tail() - thread.Anchor()).norm(), 1e-3);  // taut
}

TEST_F(SuturingTaskTest, TransferGivesTheNeedleToTheRightHand) {
  Play(&task_, {kReachRight, kCenter, kPosition, kPush, kPullLeft, kTransfer});
  EXPECT_EQ(task_.world().holder(), kRightHand);
  EXPECT_GT(task_.world().opening(kLeftHand), 0.5);
  EXPECT_LT((Left() - Right()).norm(), 30e-3);
}

TEST_F(SuturingTaskTest, OrientRegripsTheNeedleWhereItShould) {
  Play(&task_, {kReachRight, kOrient});
  EXPECT_EQ(task_.world().holder(), kRightHand);
  const Vector3d grip =
      task_.world().needle() * NeedlePoint(task_.parameters(), task_.parameters().right_grip);
  EXPECT_LT((Right() - grip).norm(), 1e-3);
  EXPECT_LT(Right().y(), -5e-3);
}

TEST_F(SuturingTaskTest, TightenAndLoosenTakeTheThread) {
  Play(&task_, {kReachRight, kCenter, kPosition, kPush, kPullLeft});
  const auto before = task_.Save();
  Play(&task_, {kTighten});
  EXPECT_TRUE(task_.suture().thread.in_right);
  EXPECT_EQ(task_.world().holder(), kLeftHand);
  EXPECT_GT(Right().x(), 15e-3);
  EXPECT_NEAR(task_.suture().thread.length, (Tail() - Right()).norm(), 1e-3);
  task_.Restore(*before);
  Play(&task_, {kLoosen});
  EXPECT_TRUE(task_.suture().thread.in_right);
  EXPECT_GT(task_.suture().thread.length, (Tail() - Right()).norm() + 10e-3);
  Play(&task_, {kTransfer});
  EXPECT_FALSE(task_.suture().thread.in_right);  // the next gesture lets it go
}

TEST_F(SuturingTaskTest, FourThrowsAndTheDropAreASuccess) {
  Play(&task_, {kReachRight, kCenter});
  for (int i = 0; i < 4; ++i) {
    std::vector<int> plan = kOneThrow;
    if (i == 3) plan.back() = kDrop;
    Play(&task_, plan);
  }
  EXPECT_EQ(task_.progress().outcome, Outcome::kSuccess);
  EXPECT_EQ(task_.progress().actions_done, task_.spec().plan_length);
  EXPECT_EQ(task_.world().holder(), kNoHand);
  EXPECT_LT(task_.world().needle().translation().z(), 2e-3);  // it fell and lies
  EXPECT_TRUE(task_.LegalActions().empty());
  const double time = task_.progress().time;
  EXPECT_GT(time, 60);
  EXPECT_LT(time, 200);
}

TEST_F(SuturingTaskTest, AfterTheLastThrowTheNeedleIsNotHandedOver) {
  Play(&task_, {kReachRight, kCenter});
  for (int i = 0; i < 3; ++i) Play(&task_, kOneThrow);
  Play(&task_, {kPosition, kPush, kPullLeft});
  const std::vector<int> legal = task_.LegalActions();
  EXPECT_EQ(legal, (std::vector<int>{kTighten, kLoosen, kDrop}));
  EXPECT_FALSE(task_.StartAction(kTransfer));
}

TEST_F(SuturingTaskTest, DroppingTooEarlyIsAFailure) {
  Play(&task_, {kReachRight, kCenter, kPosition, kPush, kPullLeft, kDrop});
  EXPECT_EQ(task_.progress().outcome, Outcome::kFailure);
  EXPECT_EQ(task_.progress().reason, "incomplete");
}

TEST_F(SuturingTaskTest, TheNeedleStaysInTheGripWhileItIsHeld) {
  Play(&task_, {kReachRight});
  const Isometry3d grip = task_.world().hand(kRightHand).inverse() * task_.world().needle();
  for (int gesture : {kCenter, kPosition}) {
    ASSERT_TRUE(task_.StartAction(gesture));
    while (task_.progress().action_state == ActionState::kRunning) {
      task_.Tick();
      const Isometry3d now = task_.world().hand(kRightHand).inverse() * task_.world().needle();
      ASSERT_LT((now.translation() - grip.translation()).norm(), 2e-4);
      ASSERT_LT(Eigen::AngleAxisd(now.linear() * grip.linear().transpose()).angle(), 0.03);
    }
  }
}

// The first reason other than success among trials of one throw with much noise, if it is `reason`
// that is looked for; at most `tries` of them.
bool FailsFor(const std::string& reason, int tries, SuturingTask* task) {
  for (int i = 0; i < tries; ++i) {
    task->Reset(3);
    task->SetNoiseSeed(static_cast<std::uint64_t>(i));
    for (int gesture : {kReachRight, kCenter, kPosition, kPush, kPullLeft}) {
      if (!RunAction(*task, gesture, nullptr)) break;
    }
    if (task->progress().reason == reason) return true;
  }
  return false;
}

TEST(SuturingFailures, ALostNeedleLiesOnThePad) {
  SuturingTask task(WithNoise(10));
  ASSERT_TRUE(FailsFor("dropped(needle)", 60, &task));
  EXPECT_EQ(task.progress().outcome, Outcome::kFailure);
  EXPECT_EQ(task.progress().action_state, ActionState::kFailed);
  EXPECT_EQ(task.world().holder(), kNoHand);
  EXPECT_TRUE(task.LegalActions().empty());
}

TEST(SuturingFailures, ANeedleFarFromItsDotMisses) {
  SuturingTask task(WithNoise(10));
  ASSERT_TRUE(FailsFor("missed(entry)", 60, &task));
  EXPECT_EQ(task.progress().action, static_cast<int>(kPush));
}

TEST(SuturingFailures, JawsThatCloseBesideTheNeedleMissIt) {
  SuturingTask task(WithNoise(10));
  ASSERT_TRUE(FailsFor("missed(needle)", 60, &task));
  EXPECT_EQ(task.progress().action_state, ActionState::kFailed);
}

TEST(SuturingFailures, TimeRunsOut) {
  SuturingTask task(WithNoise(0));
  task.Reset(1);
  while (task.progress().outcome == Outcome::kRunning) task.Tick();
  EXPECT_EQ(task.progress().reason, "time");
  EXPECT_NEAR(task.progress().time, task.parameters().trial_limit, 0.1);
}

TEST_F(SuturingTaskTest, RefusesWhatTheTableForbidsAndStaysUnharmed) {
  for (int gesture : {-1, static_cast<int>(kPush), 6, 15, 99}) {
    EXPECT_FALSE(task_.StartAction(gesture)) << gesture;
  }
  EXPECT_EQ(task_.progress().segment, -1);
  ASSERT_TRUE(task_.StartAction(kReachRight));
  EXPECT_FALSE(task_.StartAction(kReachRight));  // one runs already
}

TEST_F(SuturingTaskTest, ACancelledGestureStopsAndMayBeTakenUpAgain) {
  Play(&task_, {kReachRight, kCenter, kPosition});
  ASSERT_TRUE(task_.StartAction(kPush));
  for (int i = 0; i < 40; ++i) task_.Tick();
  task_.Cancel();
  EXPECT_EQ(task_.progress().action_state, ActionState::kCancelled);
  for (int i = 0; i < 5; ++i) task_.Tick();
  const Vector3d still = Right();
  for (int i = 0; i < 15; ++i) task_.Tick();
  EXPECT_LT((Right() - still).norm(), 5e-4);
  EXPECT_EQ(task_.LegalActions(), (std::vector<int>{kPush}));
  Play(&task_, {kPush, kPullLeft});
  EXPECT_EQ(task_.suture().throws(), 1);
}

TEST_F(SuturingTaskTest, RefusesImpossibleOptions) {
  TaskOptions options;
  options.surgeon = 8;
  EXPECT_THROW(SuturingTask{options}, std::invalid_argument);
  options = TaskOptions();
  options.frames_per_second = 7;
  EXPECT_THROW(SuturingTask{options}, std::invalid_argument);
  options = WithNoise(11);
  EXPECT_THROW(SuturingTask{options}, std::invalid_argument);
  options = TaskOptions();
  options.shift.light = 0.5;
  EXPECT_THROW(SuturingTask{options}, std::invalid_argument);
}

// Hashes pictures (every fifth), states and reasons of the trial's beginning.
std::uint64_t CourseHash(SuturingTask& task, std::uint64_t seed) {
  task.Reset(seed);
  std::uint64_t hash = 1;
  int frame = 0;
  for (int gesture : {kReachRight, kOrient, kPosition, kPush, kPullLeft}) {
    task.StartAction(gesture);
    while (task.progress().action_state == ActionState::kRunning) {
      task.Tick();
      const std::vector<double> state = task.RobotState();
      hash = base::HashBytes(state.data(), state.size() * sizeof(double), hash);
      if (++frame % 20 != 0) continue;
      const Image image = task.Observe();
      hash = base::HashBytes(image.rgb.data(), image.rgb.size(), hash);
    }
  }
  return hash;
}

TEST(SuturingRepeats, BitForBitAlsoInThreads) {
  SuturingTask task({}), fresh({});
  const std::uint64_t first = CourseHash(task, 11);
  EXPECT_NE(first, CourseHash(task, 12));
  EXPECT_EQ(first, CourseHash(task, 11));
  std::uint64_t there = 0;
  std::thread([&there] {
    SuturingTask mine({});
    there = CourseHash(mine, 11);
  }).join();
  EXPECT_EQ(first, there);
}

TEST(SuturingRepeats, InAnotherProcess) {
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    SuturingTask task({});
    const std::uint64_t hash = CourseHash(task, 21);
    _exit(write(ends[1], &hash, sizeof hash) == sizeof hash ? 0 : 1);
  }
  std::uint64_t hash = 0;
  ASSERT_EQ(read(ends[0], &hash, sizeof hash), static_cast<ssize_t>(sizeof hash));
  int status = 0;
  waitpid(child, &status, 0);
  SuturingTask task({});
  EXPECT_EQ(hash, CourseHash(task, 21));
}

TEST(SuturingRepeats, GoesOnFromASavedStateInAnotherTask) {
  SuturingTask task({}), other({});
  task.Reset(5);
  other.Reset(900);
  Play(&task, {kReachRight, kCenter, kPosition});
  ASSERT_TRUE(task.StartAction(kPush));
  for (int i = 0; i < 50; ++i) task.Tick();
  const auto state = task.Save();
  other.Restore(*state);
  for (SuturingTask* one : {&task, &other}) {
    while (one->progress().action_state == ActionState::kRunning) one->Tick();
    RunAction(*one, kPullLeft, nullptr);
  }
  EXPECT_EQ(task.RobotState(), other.RobotState());
  EXPECT_EQ(task.Observe().rgb, other.Observe().rgb);
  EXPECT_EQ(task.progress().time, other.progress().time);
}

TEST(SuturingRepeats, RefusesStatesOfOtherOptions) {
  TaskOptions fast;
  fast.frames_per_second = 30;
  SuturingTask task({}), other(fast);
  EXPECT_THROW(other.Restore(*task.Save()), std::invalid_argument);
}

TEST(SuturingRepeats, MotionDoesNotDependOnTheFrameRate) {
  TaskOptions fast;
  fast.frames_per_second = 30;
  SuturingTask slow({}), quick(fast);
  for (SuturingTask* one : {&slow, &quick}) {
    one->Reset(31);
    one->StartAction(kReachRight);
    while (one->progress().time < 3 - 1e-9) one->Tick();
  }
  EXPECT_EQ(slow.RobotState(), quick.RobotState());
}

TEST(SuturingRepeats, NoiseSeedsMoveTheEndOfAGestureALittle) {
  SuturingTask task({});
  task.Reset(8);
  const auto start = task.Save();
  std::vector<Vector3d> ends;
  for (std::uint64_t noise : {1, 1, 2}) {
    task.Restore(*start);
    task.SetNoiseSeed(noise);
    Play(&task, {kReachRight});
    ends.push_back(task.world().hand(kRightHand).translation());
  }
  EXPECT_EQ(ends[0], ends[1]);
  EXPECT_GT((ends[0] - ends[2]).norm(), 1e-6);
  EXPECT_LT((ends[0] - ends[2]).norm(), 6e-3);
}

TEST_F(SuturingTaskTest, LandmarksAreWhereThePictureShowsThem) {
  Play(&task_, {kReachRight, kCenter, kPosition});
  const std::vector<Landmark> landmarks = task_.Landmarks();
  ASSERT_EQ(landmarks.size(), task_.spec().landmarks.size());
  const Eigen::Vector2d dot = SeenAt(task_.scene().look, EntryDot(task_.parameters(), 0), 128, 96);
  EXPECT_NEAR(landmarks[2].u, dot.x(), 0.02);  // the needle's tip is on it
  EXPECT_NEAR(landmarks[2].v, dot.y(), 0.02);
  EXPECT_LT(landmarks[1].u, landmarks[0].u);  // left of the right hand
}

}  // namespace
}  // namespace prospect::sim
