// What a model server says of its weights' calibration.
#include <gtest/gtest.h>

#include <optional>

#include "model/refusal/scene_kind.h"
#include "model/scripted_engine.h"
#include "services/binding/calibration_messages.h"
#include "services/model/model_server.h"
#include "tests/unit/services/poll_until.h"

namespace prospect::services {
namespace {

class CalibrationServer : public testing::Test {
 protected:
  CalibrationServer() {
    subscriptions_.push_back(
        ear_.Subscribe<calibration_t>([this](const calibration_t& said) { calibration_ = said; }));
    subscriptions_.push_back(ear_.Subscribe<model_info_t>([this](const model_info_t& said) {
      ++infos_;
      info_ = said;
      known_before_info_ = calibration_.has_value();
    }));
  }
  // Serves until the server has introduced itself `times` times.
  bool Serve(const model::ScriptedOptions& options, int times) {
    model::ScriptedEngine engine(options);
    ModelServer server(bus_, engine, {});
    return PollUntil({&ear_}, [&] {
      server.Turn();
      return infos_ >= times;
    });
  }

  Bus bus_, ear_;
  std::optional<calibration_t> calibration_;
  model_info_t info_{};
  int infos_ = 0;
  bool known_before_info_ = false;
  std::vector<Subscription> subscriptions_;
};

TEST_F(CalibrationServer, SaysTheSampleOfItsWeightsBeforeItIntroducesItself) {
  model::ScriptedOptions options;
  model::CalibrationSample sample;
  sample.rule = "paper";
  sample.refusal_threshold = 0.25;
  sample.scenes = {{0.5, model::SceneClass::kSolvable, model::SceneEnding::kFailed}};
  sample.parameters = {{"plan_length", 5}};
  options.calibrations = {sample, sample};
  options.calibrations.back().parameters["plan_length"] = 3;
  ASSERT_TRUE(Serve(options, 1));
  EXPECT_TRUE(known_before_info_);
  ASSERT_TRUE(calibration_);
  EXPECT_EQ(calibration_->weights_hash, info_.weights_hash);
  EXPECT_EQ(calibration_->server_id, info_.server_id);
  EXPECT_EQ(calibration_->task, info_.task);
  EXPECT_EQ(info_.calibrations, 2);
  const model::CalibrationSample second = SampleFrom(*calibration_);
  EXPECT_EQ(second.scenes.at(0).score, 0.5);
  EXPECT_EQ(second.refusal_threshold, 0.25);
  EXPECT_EQ(model::KindOf(second).plan_length, 3);
}

TEST_F(CalibrationServer, SaysNothingWhereThereIsNone) {
  ASSERT_TRUE(Serve({}, 2));
  EXPECT_FALSE(calibration_);
}

}  // namespace
}  // namespace prospect::services
