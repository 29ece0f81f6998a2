// A camera keeps what did not change since its last picture. That must not be seen.
#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "sim/plan_rules.h"
#include "sim/random_plan.h"
#include "sim/task_factory.h"
#include "sim/view_cells.h"

namespace prospect::sim {
namespace {

constexpr std::uint64_t kFirstScene = 1'400'000;  // tuning scenes: in no figure

class KeptPicture : public testing::TestWithParam<const char*> {};

// The picture of a state by a camera that has nothing to keep: its last one had another size.
Image Anew(Task* task, const TaskState& state) {
  task->Restore(state);
  task->Render(16, 8);
  return task->Observe();
}

TEST_P(KeptPicture, IsTheSameAsOneTracedAnew) {
  constexpr int kTrials = 3, kTicks = 80;
  const auto task = MakeTask(GetParam()), other = MakeTask(GetParam());
  for (int trial = 0; trial < kTrials; ++trial) {
    const std::uint64_t seed = kFirstScene + static_cast<std::uint64_t>(trial);
    task->Reset(seed);
    RandomPlan plan(PlanRules(task->spec()), seed);
    for (int tick = 0; tick < kTicks; ++tick) {
      if (task->progress().action_state != ActionState::kRunning) {
        const std::vector<int> legal = task->LegalActions();
        if (legal.empty()) break;
        task->StartAction(plan.Choose(legal));
      }
      task->Tick();
      if (tick % 16 == 15) task->Render(300, 200);  // too large to be kept
      const Image kept = task->Observe();
      ASSERT_TRUE(kept.rgb == Anew(other.get(), *task->Save()).rgb)
          << "seed " << seed << ", tick " << tick;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, KeptPicture, testing::Values("navigation", "stacking", "suturing"),
                         [](const auto& one) { return std::string(one.param); });

Eigen::Isometry3d RandomPose() {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = Eigen::Quaterniond(Eigen::Vector4d::Random().normalized()).toRotationMatrix();
  pose.translation() = Eigen::Vector3d::Random();
  return pose;
}

// Boxes about an eye at (0, 0, 1): in the view, beside it, behind it, around it.
void ExpectMarked(const Projection& projection) {
  const ViewCells cells(projection, {-1, -1}, {1, 1}, 20, 30);
  for (int round = 0; round < 300; ++round) {
    const Eigen::Vector3d half = 0.3 * (Eigen::Vector3d::Random().array() + 1.01).matrix();
    const Eigen::AlignedBox3d box(-half, half);
    const Eigen::Isometry3d pose = RandomPose();
    std::vector<std::uint8_t> mask(cells.size(), 0);
    mask[ViewCells::kAlways] = 1;
    cells.Mark(box, pose, &mask);
    for (int i = 0; i < 300; ++i) {
      const Eigen::Vector3d inside = pose * half.cwiseProduct(Eigen::Vector3d::Random());
      ASSERT_TRUE(mask[cells.CellOf(inside)]) << "round " << round << ": " << inside.transpose();
    }
  }
}

TEST(ViewCells, MarksWhatABoxCoversInPerspective) {
  ExpectMarked(Projection::Perspective({0, 0, 1}, -Eigen::Vector3d::UnitZ(),
                                       0.5 * Eigen::Vector3d::UnitX(),
                                       0.4 * Eigen::Vector3d::UnitY()));
}

TEST(ViewCells, MarksWhatABoxCoversFromFarAway) {
  ExpectMarked(Projection::Parallel(Eigen::Vector3d(1, 2, 3).normalized()));
}

TEST(ViewCells, LeavesOutWhatABoxIsFarFrom) {
  const ViewCells cells(Projection::Parallel(Eigen::Vector3d::UnitZ()), {-1, -1}, {1, 1}, 20, 20);
  std::vector<std::uint8_t> mask(cells.size(), 0);
  const Eigen::Vector3d half = Eigen::Vector3d::Constant(0.24);
  cells.Mark(Eigen::AlignedBox3d(-half, half), Eigen::Isometry3d::Identity(), &mask);
  int marked = 0;
  for (const std::uint8_t cell : mask) marked += cell;
  EXPECT_EQ(marked, 6 * 6);
  EXPECT_FALSE(mask[ViewCells::kNever]);
}

}  // namespace
}  // namespace prospect::sim
