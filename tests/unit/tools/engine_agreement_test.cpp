#include "tools/bench/engine_agreement.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "model/engine.h"

namespace prospect::tools {
namespace {

constexpr int kScenes = 12;
constexpr double kStep = 1.0 / 255;  // of a pixel, which is rounded last

EngineAgreement Agreement(const std::string& task) {
  const std::string weights =
      std::string(PROSPECT_ROOT) + "/model/weights/" + task + ".safetensors";
  const auto engine = model::LoadEngine(weights, 1);
  const auto reference = model::LoadTorchEngine(weights, 1);
  return Compare(*engine, *reference, task, 1'000'000, kScenes);
}

// Ten imagined actions in a row, each from the engine's own state, and a whole search: what the
// kernels round otherwise than libtorch does stays small and changes no plan.
class EngineAgreementTest : public testing::TestWithParam<const char*> {};

TEST_P(EngineAgreementTest, BundledWeightsPlanTheSameInLibtorch) {
  const EngineAgreement agreement = Agreement(GetParam());
  EXPECT_EQ(agreement.states, 10 * kScenes);
  EXPECT_LT(agreement.judged, 2e-4);
  EXPECT_LT(agreement.state, 2e-4);
  EXPECT_LE(agreement.picture, 1.001 * kStep);
  EXPECT_EQ(agreement.decisions, kScenes);
  EXPECT_EQ(agreement.differing, 0) << "scores " << agreement.tie << " apart";
}

INSTANTIATE_TEST_SUITE_P(Tasks, EngineAgreementTest, testing::Values("stacking", "navigation"),
                         [](const auto& test) { return std::string(test.param); });

TEST(EngineAgreement, WhereNothingIsJudgedPicturesAreComparedAlone) {
  const EngineAgreement agreement = Agreement("suturing");
  EXPECT_EQ(agreement.decisions, 0);
  EXPECT_EQ(agreement.judged, 0);
  EXPECT_LT(agreement.state, 2e-4);
  EXPECT_LE(agreement.picture, 1.001 * kStep);
}

}  // namespace
}  // namespace prospect::tools
