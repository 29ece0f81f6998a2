// The parts of the suturing world that need no trial: table and chain of gestures, the needle's
// geometry, movements, the drawn thread, the endoscope.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/random.h"
#include "sim/suturing/endoscope.h"
#include "sim/suturing/gestures.h"
#include "sim/suturing/motion.h"
#include "sim/suturing/needle.h"
#include "sim/suturing/scene.h"
#include "sim/suturing/suturing_world.h"
#include "sim/suturing/thread.h"

namespace prospect::sim {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

const Vector3d kNowhere = Vector3d::Zero();

const SuturingParameters& P() { return TheSuturingParameters(); }

TEST(SuturingGestures, HaveTheVocabularysNumbers) {
  const std::vector<ActionSpec> actions = SuturingActions();
  ASSERT_EQ(actions.size(), 15u);
  for (int i = 0; i < 15; ++i) {
    EXPECT_EQ(actions[i].index, i);
    EXPECT_EQ(actions[i].name, "G" + std::to_string(i + 1));
    EXPECT_FALSE(actions[i].kind.empty());
  }
  EXPECT_EQ(actions[kPush].name, "G3");
  EXPECT_EQ(actions[kDrop].name, "G11");
}

TEST(SuturingGestures, SuccessorsUseTheTenOfSuturing) {
  const std::vector<std::vector<int>> successors = SuturingSuccessors();
  ASSERT_EQ(successors.size(), 16u);
  std::set<int> used;
  for (const std::vector<int>& row : successors) used.insert(row.begin(), row.end());
  EXPECT_EQ(used, (std::set<int>{kReachRight, kPosition, kPush, kTransfer, kCenter, kPullLeft,
                                 kOrient, kTighten, kLoosen, kDrop}));
  EXPECT_EQ(successors.back(), (std::vector<int>{kReachRight}));
  EXPECT_EQ(successors[kPosition], (std::vector<int>{kPush}));
  EXPECT_EQ(successors[kPush], (std::vector<int>{kPullLeft}));
  EXPECT_TRUE(successors[kDrop].empty());
  for (int unused : {6, 11, 12, 13, 14}) EXPECT_TRUE(successors[unused].empty());
}

TEST(SuturingGestures, TheChainKeepsToTheTableAndEndsOnlyWhenAllIsSewn) {
  const std::vector<std::vector<int>> successors = SuturingSuccessors();
  base::Random random(3);
  std::set<std::pair<int, int>> seen;
  for (int round = 0; round < 300; ++round) {
    for (int from = 0; from <= kGestures; ++from) {
      if (successors[from].empty()) continue;
      const int early = ChooseGesture(from, successors[from], false, &random);
      const int late = ChooseGesture(from, successors[from], true, &random);
      EXPECT_NE(early, kDrop);
      for (int to : {early, late}) {
        EXPECT_NE(std::find(successors[from].begin(), successors[from].end(), to),
                  successors[from].end());
        seen.insert({from, to});
      }
    }
  }
  std::size_t all = 0;
  for (const std::vector<int>& row : successors) all += row.size();
  EXPECT_EQ(seen.size(), all);  // every step of the table occurs
}

TEST(SuturingNeedle, DrivingItTakesTheTipFromDotToDot) {
  for (int i = 0; i < P().throws; ++i) {
    const Vector3d in = DrivePose(P(), i, EntryAngle(P())) * NeedlePoint(P(), 0);
    const Vector3d out = DrivePose(P(), i, ExitAngle(P())) * NeedlePoint(P(), 0);
    EXPECT_LT((in - EntryDot(P(), i)).norm(), 1e-9);
    EXPECT_LT((out - ExitDot(P(), i)).norm(), 1e-9);
    const Vector3d deep = DrivePose(P(), i, -M_PI / 2) * NeedlePoint(P(), 0);
    EXPECT_LT(deep.z(), -1e-3);
  }
}

TEST(SuturingNeedle, TheRightGripStaysAboveTheTissue) {
  const double last = ExitAngle(P()) - P().emerge;
  for (double angle = EntryAngle(P()); angle >= last; angle -= 0.05) {
    const Isometry3d needle = DrivePose(P(), 0, angle);
    EXPECT_GT((needle * NeedlePoint(P(), P().right_grip)).z(), 0);
  }
  EXPECT_GT((DrivePose(P(), 0, last) * NeedlePoint(P(), P().left_grip)).z(), 0);
}

TEST(SuturingNeedle, AGripIsARotationPerpendicularToTheNeedle) {
  const Isometry3d grip = GripAt(P(), 1.1);
  EXPECT_NEAR(grip.linear().determinant(), 1, 1e-12);
  EXPECT_TRUE((grip.linear().transpose() * grip.linear()).isIdentity(1e-12));
  EXPECT_EQ(grip.linear().col(2), -Vector3d::UnitZ());
  EXPECT_EQ(grip.translation(), NeedlePoint(P(), 1.1));
}

TEST(SuturingNeedle, DistanceToTheWire) {
  const Isometry3d needle = DrivePose(P(), 1, 0.3);
  EXPECT_NEAR(DistanceToWire(P(), needle, needle * NeedlePoint(P(), 2.0)), 0, 1e-12);
  EXPECT_NEAR(DistanceToWire(P(), needle, needle * Vector3d(0, 0, 2e-3)),
              std::hypot(P().needle_radius, 2e-3), 1e-9);
  // Beyond the tip the tip is nearest.
  const Vector3d beyond = NeedlePoint(P(), 0) + Vector3d(0, -3e-3, 0);
  EXPECT_NEAR(DistanceToWire(P(), needle, needle * beyond), 3e-3, 1e-9);
}

TEST(SuturingMotion, MinimumJerkStartsAndEndsAtRest) {
  EXPECT_EQ(MinimumJerk(-1), 0);
  EXPECT_EQ(MinimumJerk(0), 0);
  EXPECT_EQ(MinimumJerk(0.5), 0.5);
  EXPECT_EQ(MinimumJerk(1), 1);
  EXPECT_EQ(MinimumJerk(2), 1);
  EXPECT_LT(MinimumJerk(1e-3), 1e-7);
  EXPECT_GT(MinimumJerk(1 - 1e-3), 1 - 1e-7);
}

TEST(SuturingMotion, AFreeMoveBendsAndArrives) {
  HandMove move;
  move.to.translation() = Vector3d(0.03, 0, 0);
  move.to.rotate(Eigen::AngleAxisd(1, Vector3d::UnitY()));
  move.early_bend = move.late_bend = Vector3d(0, 0, 4e-3);
  EXPECT_TRUE(move.At(0).isApprox(move.from, 1e-12));
  EXPECT_TRUE(move.At(1).isApprox(move.to, 1e-12));
  const Vector3d half = move.At(0.5).translation();
  EXPECT_NEAR(half.x(), 0.015, 1e-12);
  EXPECT_NEAR(half.z(), 3e-3, 1e-12);  // a Bezier curve's middle
}

TEST(SuturingMotion, ATurnKeepsTheDistanceFromItsCentre) {
  HandMove move;
  move.from.translation() = Vector3d(0.01, 0.02, 0.03);
  move.circular = true;
  move.center = Vector3d(0.01, 0, 0.03);
  move.axis = Vector3d::UnitZ();
  move.angle = M_PI / 2;
  for (double share : {0.0, 0.3, 0.8, 1.0}) {
    EXPECT_NEAR((move.At(share).translation() - move.center).norm(), 0.02, 1e-12);
  }
  EXPECT_LT((move.At(1).translation() - Vector3d(-0.01, 0, 0.03)).norm(), 1e-12);
}

TEST(SuturingThread, SlackIsKeptAndPullingTightens) {
  SuturingThread thread;
  thread.end = Vector3d(0.02, -0.01, 0);
  thread.length = 0.03;
  const Vector3d close(0.01, 0, 0.005), far(-0.04, 0, 0.005);
  thread.Reach(close, kNowhere, false);
  EXPECT_EQ(thread.length, 0.03);
  thread.Reach(far, kNowhere, false);  // cannot be shorter than the way
  EXPECT_NEAR(thread.length, (far - thread.Anchor()).norm(), 1e-12);
  thread.Reach(close, kNowhere, true);
  EXPECT_NEAR(thread.length, (close - thread.Anchor()).norm(), 1e-12);
}

TEST(SuturingThread, StrandsRunFromStitchToStitchAndStayAboveThePad) {
  SuturingThread thread;
  thread.end = Vector3d(0.02, 0, 0);
  thread.passed = 2;
  for (int i = 0; i < 2; ++i) thread.stitches[i] = {EntryDot(P(), i), ExitDot(P(), i)};
  thread.length = 0.05;
  thread.feed = 0.01;
  const Vector3d tail(-0.02, 0.01, 0.02);
  const std::vector<Strand> strands = ThreadStrands(thread, tail, kNowhere);
  ASSERT_EQ(strands.size(), 3u);  // end to stitch 0, stitch 0 to 1, stitch 1 to the needle
  EXPECT_NEAR((strands[1].front() - ExitDot(P(), 0)).head<2>().norm(), 0, 1e-9);
  EXPECT_NEAR((strands[1].back() - EntryDot(P(), 1)).head<2>().norm(), 0, 1e-9);
  EXPECT_LT((strands[2].back() - tail).norm(), 1e-9);
  for (const Strand& strand : strands) {
    for (const Vector3d& point : strand) EXPECT_GE(point.z(), 0);
  }
}

TEST(SuturingThread, TheRightHandHoldsIt) {
  SuturingThread thread;
  thread.in_right = true;
  const Vector3d right(0.02, 0.01, 0.01), tail(-0.02, 0, 0.02);
  thread.Reach(tail, right, true);
  const std::vector<Strand> strands = ThreadStrands(thread, tail, right);
  ASSERT_EQ(strands.size(), 2u);
  EXPECT_EQ(strands[0].back(), right);
  EXPECT_EQ(strands[1].front(), right);
}

TEST(SuturingThread, ABuriedTailShowsThreadOnlyAsFarAsTheEntry) {
  SuturingThread thread;
  thread.length = 0.03;
  thread.entered = true;
  thread.stitches[0] = {EntryDot(P(), 0), ExitDot(P(), 0)};
  const std::vector<Strand> strands = ThreadStrands(thread, Vector3d(0, 0.015, -3e-3), kNowhere);
  EXPECT_NEAR((strands.back().back() - EntryDot(P(), 0)).head<2>().norm(), 0, 1e-9);
}

// The pictures of a scene with the hands at rest.
struct StillLife {
  explicit StillLife(std::uint64_t seed) : scene(DrawSuturingScene(seed, -1, P())) {
    for (int i = 0; i < 2; ++i) AppendInstrument(P(), i, scene.hands[i], 0.3, &poses);
    poses.push_back(scene.needle);
  }
  Image Render(double sideways = 0) const {
    return Endoscope(P(), scene.look).Render(poses, {}, scene.light, sideways, 64, 48);
  }
  SuturingScene scene;
  std::vector<Isometry3d> poses;
};

TEST(SuturingEndoscope, ScenesDifferBySeedAndRepeat) {
  EXPECT_EQ(StillLife(5).Render().rgb, StillLife(5).Render().rgb);
  EXPECT_NE(StillLife(5).Render().rgb, StillLife(6).Render().rgb);
}

TEST(SuturingEndoscope, TheOtherEyeSeesThingsShifted) {
  StillLife still(5);
  EXPECT_NE(still.Render(0).rgb, still.Render(5e-3).rgb);
}

TEST(SuturingEndoscope, SeesThePadInTheMiddleAndDotsWhereTheyAre) {
  StillLife still(9);
  const Image image = Endoscope(P(), still.scene.look).Render(still.poses, {}, 1, 0, 640, 480);
  const auto shade = [&](const Vector3d& point) {
    const Eigen::Vector2d at = SeenAt(still.scene.look, point, 640, 480);
    const auto x = static_cast<int>(at.x() * 640), y = static_cast<int>(at.y() * 480);
    return image.rgb[(static_cast<std::size_t>(y) * 640 + x) * 3];
  };
  for (int i = 0; i < P().throws; ++i) {
    for (const Vector3d& dot : {EntryDot(P(), i), ExitDot(P(), i)}) {
      EXPECT_LT(shade(dot), 90) << i;
      EXPECT_GT(shade(dot + Vector3d(0, 4e-3, 0)), 120) << i;  // bare pad beside it
    }
  }
}

TEST(SuturingEndoscope, RefusesImpossiblePictures) {
  StillLife still(1);
  Endoscope endoscope(P(), still.scene.look);
  EXPECT_THROW(endoscope.Render(still.poses, {}, 1, 0, 0, 48), std::invalid_argument);
  EXPECT_THROW(endoscope.Render({}, {}, 1, 0, 64, 48), std::invalid_argument);
}

// Runs a world for `seconds` with both hands wanted at `target`.
void Hold(SuturingWorld* world, const std::array<Isometry3d, 2>& targets, double seconds) {
  for (double t = 0; t < seconds; t += P().step) {
    for (int i = 0; i < 2; ++i) world->Steer(i, targets[i], 0.2);
    world->Step();
  }
}

TEST(SuturingWorld, HandsGoWhereTheyAreWanted) {
  SuturingWorld world(P());
  world.Place({RestPose(0), RestPose(1)}, Isometry3d(Eigen::Translation3d(0, 0, 0.01)));
  std::array<Isometry3d, 2> targets = {RestPose(0), RestPose(1)};
  targets[0].translation() += Vector3d(0.01, -0.02, 0.01);
  targets[1].rotate(Eigen::AngleAxisd(0.8, Vector3d(1, 2, 3).normalized()));
  Hold(&world, targets, 0.5);
  for (int i = 0; i < 2; ++i) {
    EXPECT_LT((world.hand(i).translation() - targets[i].translation()).norm(), 1e-4);
    EXPECT_TRUE(world.hand(i).linear().isApprox(targets[i].linear(), 1e-3));
    EXPECT_NEAR(world.opening(i), 0.2, 1e-9);
  }
}

TEST(SuturingWorld, AFreeNeedleFallsAndLiesOnThePad) {
  SuturingWorld world(P());
  const std::array<Isometry3d, 2> hands = {RestPose(0), RestPose(1)};
  world.Place(hands, Isometry3d(Eigen::Translation3d(0, 0, 0.015) *
                                Eigen::AngleAxisd(1.2, Vector3d::UnitX())));
  Hold(&world, hands, 2);
  double high = 0;
  for (double angle = 0; angle <= M_PI; angle += 0.2) {
    const Vector3d at = world.needle() * NeedlePoint(P(), angle);
    EXPECT_GT(at.z(), 0);
    high = std::max(high, at.z());
  }
  EXPECT_LT(high, 2e-3);  // flat
  const Isometry3d before = world.needle();
  Hold(&world, hands, 0.5);
  EXPECT_LT((world.needle().translation() - before.translation()).norm(), 2e-4);
}

TEST(SuturingWorld, AHeldNeedleFollowsTheHandAndIsLetGo) {
  SuturingWorld world(P());
  std::array<Isometry3d, 2> hands = {RestPose(0), RestPose(1)};
  world.Place(hands, hands[0] * GripAt(P(), P().right_grip).inverse());
  world.Hold(kRightHand);
  const Isometry3d grip = world.hand(0).inverse() * world.needle();
  hands[0].translation() += Vector3d(-0.02, 0.01, 0.01);
  hands[0].rotate(Eigen::AngleAxisd(2, Vector3d::UnitZ()));
  Hold(&world, hands, 0.6);
  EXPECT_EQ(world.holder(), kRightHand);
  EXPECT_TRUE((world.hand(0).inverse() * world.needle()).isApprox(grip, 1e-3));
  EXPECT_GT(world.needle().translation().z(), 5e-3);
  world.Hold(kNoHand);
  Hold(&world, hands, 1.5);
  EXPECT_LT(world.needle().translation().z(), 2e-3);
}

TEST(SuturingWorld, GoesOnFromASavedStateBitForBitWhileItHoldsTheNeedle) {
  SuturingWorld world(P()), other(P());
  std::array<Isometry3d, 2> hands = {RestPose(0), RestPose(1)};
  world.Place(hands, hands[1] * GripAt(P(), P().left_grip).inverse());
  world.Hold(kLeftHand);
  hands[1].translation() += Vector3d(0.02, 0.01, 0.01);
  Hold(&world, hands, 0.1);
  const SuturingWorld::State state = world.Save();
  other.Restore(state);
  EXPECT_EQ(other.holder(), kLeftHand);
  Hold(&world, hands, 0.2);
  Hold(&other, hands, 0.2);
  EXPECT_EQ(world.needle().matrix(), other.needle().matrix());
  EXPECT_EQ(world.hand(1).matrix(), other.hand(1).matrix());
}

TEST(SuturingScene, StaysWithinLimitsAndFollowsTheSurgeon) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const SuturingScene scene = DrawSuturingScene(seed, -1, P());
    EXPECT_GE(scene.light, 0.9);
    EXPECT_LE(scene.light, 1.1);
    EXPECT_LT(std::abs(scene.needle.translation().x()), P().half_width);
    EXPECT_LT(std::abs(scene.needle.translation().y()), P().half_length);
    EXPECT_EQ(std::abs(scene.thread_side), 1);
  }
  EXPECT_EQ(DrawSuturingScene(4, 2, P()).style.pace, StyleOf(2).pace);
  EXPECT_EQ(DrawSuturingScene(4, 2, P()).light, DrawSuturingScene(4, 3, P()).light);
}

}  // namespace
}  // namespace prospect::sim
