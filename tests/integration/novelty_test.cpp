// Pictures unlike those that the networks were trained on, over the bus: refused as such by the
// executive before anything is done. With real networks, which are told here what is known.

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "tests/integration/support/deployment.h"

namespace prospect::tests {
namespace {

constexpr int kEpisodeMs = 60000;
// With the few scenes of this test no picture gets a p-value below 2 / 121.
const std::vector<std::string> kLevel = {"--novelty", "0.05", "--samples", "10"};

bool Holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

class Recognising : public ::testing::Test {
 protected:
  // A copy of the bundled weights that knows the pictures of 300 scenes.
  static std::string Calibrated(const Deployment& deployment) {
    const std::string weights = deployment.folder + "/navigation.safetensors";
    std::filesystem::copy_file(std::string(PROSPECT_ROOT) + "/model/weights/navigation.safetensors",
                               weights, std::filesystem::copy_options::overwrite_existing);
    Process calibrate("prospect-evaluate",
                      {"novelty", "--task", "navigation", "--weights", weights, "--scenes", "300"},
                      deployment.folder + "/calibrate.log");
    EXPECT_EQ(calibrate.Wait(120000), 0) << ReadText(deployment.folder + "/calibrate.log");
    return weights;
  }

  bool AllReady() {
    return witness_.Until(
        [&] {
          return witness_.Ready("simulator", 1) && witness_.Ready("model", 1) &&
                 witness_.Ready("worker", 1);
        },
        20000);
  }

  int EndOf(Process& process) {
    int code = -1;
    EXPECT_TRUE(witness_.Until([&] { return (code = process.Wait(0)) >= 0; }, kEpisodeMs));
    return code;
  }

  static std::string Page(const Deployment& deployment) {
    return ReadText(deployment.folder + "/out/explain.html");
  }

  Witness witness_;
};

std::vector<std::string> With(std::vector<std::string> some, const std::vector<std::string>& more) {
  some.insert(some.end(), more.begin(), more.end());
  return some;
}

TEST_F(Recognising, AForeignPictureIsRefusedBeforeAnythingIsDone) {
  Deployment deployment("novelty_foreign");
  const std::string weights = Calibrated(deployment);
  deployment.Simulator({"--factor", "colour", "--strength", "5"});
  const Process server("prospect-model-server", {"--weights", weights},
                       deployment.folder + "/server.log");
  deployment.Worker();
  ASSERT_TRUE(AllReady());
  EXPECT_EQ(EndOf(deployment.Executive(kLevel)), 3);
  auto result = deployment.Result();
  EXPECT_EQ(result.at("outcome"), "refused");
  const std::string reason = result.at("reason");
  EXPECT_TRUE(Holds(reason, "this picture is unlike what the networks were trained on (p 0.01"))
      << reason;
  EXPECT_TRUE(Holds(reason, "99 % of known pictures stay below")) << reason;
  EXPECT_TRUE(result.at("actions").empty());
  EXPECT_TRUE(witness_.commands.empty());
  ASSERT_FALSE(witness_.plans.empty());
  EXPECT_EQ(witness_.plans.back().decision, plan_t::DECISION_REFUSE);
  EXPECT_EQ(witness_.plans.back().reason, reason);
  EXPECT_EQ(result.at("novelty").at("unlike"), true);
  EXPECT_GT(result.at("novelty").at("residual"), result.at("novelty").at("residual_limit"));
  EXPECT_TRUE(Holds(Page(deployment), "The picture is unlike known ones"));

  // Whoever wants no such refusal gets none.
  EndOf(deployment.Executive({"--novelty", "0", "--samples", "10", "--explain-only"}));
  result = deployment.Result();
  EXPECT_FALSE(Holds(result.at("reason"), "unlike"));
  EXPECT_FALSE(result.contains("novelty"));
}

TEST_F(Recognising, AKnownPictureIsNot) {
  Deployment deployment("novelty_known");
  const std::string weights = Calibrated(deployment);
  deployment.Simulator();
  const Process server("prospect-model-server", {"--weights", weights},
                       deployment.folder + "/server.log");
  deployment.Worker();
  ASSERT_TRUE(AllReady());
  EndOf(deployment.Executive(With(kLevel, {"--explain-only"})));
  const auto result = deployment.Result();
  EXPECT_EQ(result.at("novelty").at("unlike"), false) << result.at("novelty");
  EXPECT_FALSE(Holds(result.at("reason"), "unlike"));
  EXPECT_TRUE(Holds(Page(deployment), "The picture is like known ones"));
}

TEST_F(Recognising, WithoutKnownPicturesNothingIsRefusedForThem) {
  Deployment deployment("novelty_none");
  ASSERT_TRUE(deployment.Up(witness_, 1));
  EXPECT_EQ(EndOf(deployment.Executive({"--explain-only"})), 0);
  EXPECT_FALSE(deployment.Result().contains("novelty"));
  EXPECT_FALSE(Holds(Page(deployment), "known ones"));
  EXPECT_TRUE(Holds(deployment.Log("4-prospect-executive"), "nothing is refused for its picture"));
}

}  // namespace
}  // namespace prospect::tests
