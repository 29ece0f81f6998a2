// Promises about refusals on their way from a calibration on the bus to the answer. The test says
// the calibration itself, in the name of the scripted weights, which carry none.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/integration/support/deployment.h"

namespace prospect::tests {
namespace {

constexpr int kEpisodeMs = 60000;

bool Holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

class Promises : public ::testing::Test {
 protected:
  Promises() {
    subscription_ = witness_.bus.Subscribe<model_info_t>(
        [this](const model_info_t& info) { calibration_.weights_hash = info.weights_hash; });
  }

  // Solvable scenes that score 0.01, 0.02, ...; below 0.3 they fail, above they are solved.
  void Calibrate() {
    calibration_.task = "navigation";
    calibration_.rule = "paper";
    calibration_.parameter_names = {"samples"};
    calibration_.parameter_values = {150};
    for (int i = 1; i <= 99; ++i) {
      calibration_.scores.push_back(static_cast<float>(i) / 100);
      calibration_.classes.push_back(calibration_t::CLASS_SOLVABLE);
      calibration_.endings.push_back(i < 30 ? calibration_t::ENDING_FAILED
                                            : calibration_t::ENDING_SOLVED);
    }
    messages::SetCounts(calibration_);
  }

  int Explain(Deployment& deployment, std::vector<std::string> more) {
    more.insert(more.begin(), "--explain-only");
    auto& executive = deployment.Executive(more);
    int code = -1;
    EXPECT_TRUE(witness_.Until([&] { return (code = executive.Wait(0)) >= 0; }, kEpisodeMs,
                               [&] { Say(); }));
    deployment.Forget(executive);
    return code;
  }

  void Say() {
    if (!calibration_.scores.empty() && calibration_.weights_hash != 0)
      witness_.bus.Publish(calibration_);
  }

  double LatestThreshold() const {
    const search_root_t& root = witness_.roots.back();
    for (std::size_t i = 0; i < root.parameter_names.size(); ++i) {
      if (root.parameter_names[i] == "refusal_threshold") return root.parameter_values[i];
    }
    return -1;
  }

  Witness witness_;
  calibration_t calibration_{};
  services::Subscription subscription_;
};

TEST_F(Promises, AreKeptByTheCalibrationOfTheWeights) {
  Deployment deployment("promise_kept");
  ASSERT_TRUE(deployment.Up(witness_, 1));
  Calibrate();
  const int code = Explain(deployment, {"--refuse-at-most", "0.1"});
  EXPECT_TRUE(code == 0 || code == 3) << code;
  ASSERT_FALSE(witness_.roots.empty());
  EXPECT_NEAR(LatestThreshold(), 0.10, 1e-6);  // the tenth of 99
  auto refusals = deployment.Result().at("refusals");
  EXPECT_EQ(refusals.at("calibration_scenes"), 99);
  EXPECT_TRUE(Holds(refusals.at("promises").at(0), "Refuses at most 10 % of what can be done"));
  EXPECT_EQ(refusals.at("caveat"), "");
  const std::string page = ReadText(deployment.folder + "/out/explain.html");
  EXPECT_EQ(Holds(page, "Succeeds in about"), !deployment.Result().at("confidence").is_null());
  EXPECT_TRUE(Holds(page, "When to refuse"));
  EXPECT_TRUE(Holds(page, "<svg "));

  // Both at once cannot be had: failing seldom holds, and the curve is shown.
  Explain(deployment, {"--refuse-at-most", "0.1", "--fail-at-most", "0.1", "--samples", "100"});
  EXPECT_GT(LatestThreshold(), 0.15);
  refusals = deployment.Result().at("refusals");
  EXPECT_TRUE(Holds(refusals.at("promises").back(), "Both cannot be had"));
  EXPECT_TRUE(Holds(refusals.at("caveat"), "samples 100 instead of 150"));
  const std::string said = deployment.Log("5-prospect-executive");
  EXPECT_TRUE(Holds(said, "Both cannot be had")) << said;
  EXPECT_TRUE(Holds(said, " threshold   attempted")) << said;
}

// Where no plan is to be carried out nobody says how it would fare.
TEST_F(Promises, ARefusedSceneHasNoConfidence) {
  Deployment deployment("promise_refused");
  ASSERT_TRUE(deployment.Up(witness_, 1));
  Calibrate();
  EXPECT_EQ(Explain(deployment, {"--refusal-threshold", "1"}), 3);
  const auto result = deployment.Result();
  EXPECT_GT(result.at("searches").at(0).at("score"), 0.01) << "scores like it were calibrated";
  EXPECT_TRUE(result.at("confidence").is_null()) << result.at("confidence");
  EXPECT_EQ(result.at("refusals").at("calibration_scenes"), 99) << "it was heard";
  for (const std::string& said :
       {deployment.Log("4-prospect-executive"), ReadText(deployment.folder + "/out/explain.html")})
    EXPECT_FALSE(Holds(said, "ucceeds in about")) << said;
}

TEST_F(Promises, ThatNoThresholdKeepsAreRefusedBeforeAnythingIsSearched) {
  Deployment deployment("promise_impossible");
  ASSERT_TRUE(deployment.Up(witness_, 1));
  Calibrate();
  EXPECT_EQ(Explain(deployment, {"--fail-at-most", "0.001"}), 3);
  EXPECT_TRUE(witness_.roots.empty());
  const auto result = deployment.Result();
  EXPECT_EQ(result.at("outcome"), "refused");
  EXPECT_TRUE(Holds(result.at("reason"), "cannot be promised"));
  EXPECT_TRUE(Holds(ReadText(deployment.folder + "/out/explain.html"), "cannot be promised"));
}

TEST_F(Promises, WithoutACalibrationNothingIsPromised) {
  Deployment deployment("promise_unknown");
  ASSERT_TRUE(deployment.Up(witness_, 1));
  EXPECT_EQ(Explain(deployment, {"--refuse-at-most", "0.1"}), 10);
  EXPECT_TRUE(Holds(deployment.Log("4-prospect-executive"), "carry no calibration sample"));
  EXPECT_TRUE(witness_.roots.empty());
  EXPECT_EQ(Explain(deployment, {"--refuse-at-most", "1.5"}), 2);
  EXPECT_EQ(Explain(deployment, {"--refuse-at-most", "0.1", "--refusal-threshold", "0.3"}), 2);
}

// The bundled weights were calibrated on plans of three actions among four objects, and of five
// among seven; here are three among seven.
TEST_F(Promises, AreNotCarriedOverToScenesOfAnotherKind) {
  Deployment deployment("promise_other_kind");
  deployment.Simulator();
  const Process server("prospect-model-server",
                       {"--weights", PROSPECT_ROOT "/model/weights/navigation.safetensors"},
                       deployment.folder + "/model.log");
  deployment.Worker();
  const auto explain = [&](std::vector<std::string> more) {
    more.insert(more.end(), {"--samples", "20", "--novelty", "0"});
    return Explain(deployment, more);
  };
  EXPECT_EQ(explain({}), 3);
  auto result = deployment.Result();
  EXPECT_TRUE(Holds(result.at("reason"), "how often they succeed here is not known")) << result;
  EXPECT_TRUE(
      Holds(result.at("not_covered"),
            "plans of 3 actions among 4 objects and on plans of 5 actions among 7 objects, not "
            "on plans of 3 actions among 7"))
      << result;
  EXPECT_TRUE(result.at("confidence").is_null());
  EXPECT_EQ(LatestThreshold(), 0) << "that of the calibration does not hold";
  EXPECT_TRUE(Holds(deployment.Log("3-prospect-executive"), "may not have been trained for"));
  EXPECT_TRUE(Holds(ReadText(deployment.folder + "/out/explain.html"), "were calibrated on"));

  explain({"--refusal-threshold", "0.25"});
  EXPECT_FALSE(Holds(deployment.Result().at("reason"), "is not known"));
  EXPECT_NEAR(LatestThreshold(), 0.25, 1e-6) << "what a person says does";
  EXPECT_EQ(explain({"--refuse-at-most", "0.1"}), 10);
  EXPECT_TRUE(Holds(deployment.Log("5-prospect-executive"), "nothing can be promised"));

  explain({"--objects", "4"});
  result = deployment.Result();
  EXPECT_EQ(result.at("not_covered"), "");
  EXPECT_GT(LatestThreshold(), 0.01) << "the weights' own";
}

}  // namespace
}  // namespace prospect::tests
