// The explanation of real programs with scripted weights: what the page says is what result.json
// says, a plan that a person names is judged by the model and the rules, and nothing is carried
// out.

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "tests/integration/support/deployment.h"

namespace prospect::tests {
namespace {

constexpr int kEpisodeMs = 60000;

// The executive's exit status after one explanation; what it printed is in its log.
class Explaining : public ::testing::Test {
 protected:
  int Explain(Deployment& deployment, std::vector<std::string> more) {
    more.insert(more.begin(), "--explain-only");
    auto& executive = deployment.Executive(more);
    int code = -1;
    EXPECT_TRUE(witness_.Until([&] { return (code = executive.Wait(0)) >= 0; }, kEpisodeMs));
    deployment.Forget(executive);
    return code;
  }

  static std::string Page(const Deployment& deployment) {
    return ReadText(deployment.folder + "/out/explain.html");
  }

  // Names of the chosen plan's actions.
  static std::vector<std::string> Chosen(const Deployment& deployment) {
    return deployment.Result().at("searches").at(0).at("plan").get<std::vector<std::string>>();
  }

  Witness witness_;
};

bool Holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST_F(Explaining, SaysWhatResultJsonSaysAndCarriesNothingOut) {
  Deployment deployment("explain_act");
  ASSERT_TRUE(deployment.Up(witness_, 2));
  EXPECT_EQ(Explain(deployment, {}), 0);
  const auto result = deployment.Result();
  EXPECT_EQ(result.at("outcome"), "explained");
  EXPECT_EQ(result.at("exit_code"), 0);
  EXPECT_TRUE(result.at("acts").empty());
  EXPECT_TRUE(witness_.commands.empty());
  const auto& search = result.at("searches").at(0);
  EXPECT_EQ(search.at("decision"), "act");
  const std::string page = Page(deployment);
  EXPECT_TRUE(Holds(page, "Act: begin with " + search.at("plan").at(0).get<std::string>()));
  EXPECT_TRUE(Holds(page, result.at("weights_hash").get<std::string>()));
  EXPECT_TRUE(Holds(page, "The best alternatives, and why each lost"));
  EXPECT_TRUE(Holds(page, "Scores less: ")) << "with 150 rollouts there are others to compare";
  EXPECT_FALSE(Holds(page, "no future was followed to its end")) << "each first action is known";
  const std::string said = deployment.Log("5-prospect-executive");
  EXPECT_TRUE(Holds(said, "Act: begin with ")) << said;
  EXPECT_TRUE(Holds(said, "Alternatives:\n")) << said;
  EXPECT_TRUE(std::filesystem::exists(deployment.folder + "/out/chosen.png"));
  EXPECT_TRUE(Holds(page, "data:image/png;base64,"));
  EXPECT_FALSE(std::filesystem::exists(deployment.folder + "/out/episode.mp4"));
}

TEST_F(Explaining, ARefusalSaysWhy) {
  Deployment deployment("explain_refusal");
  ASSERT_TRUE(deployment.Up(witness_, 1));
  EXPECT_EQ(Explain(deployment, {"--refusal-threshold", "1"}), 3);
  const auto result = deployment.Result();
  EXPECT_EQ(result.at("outcome"), "refused");
  EXPECT_EQ(result.at("searches").at(0).at("decision"), "refuse");
  const std::string page = Page(deployment);
  EXPECT_TRUE(Holds(page, ">Refuse</h1>"));
  EXPECT_TRUE(Holds(page, "The best that was imagined"));
  EXPECT_TRUE(Holds(page, "under which plans are refused"));
  EXPECT_TRUE(witness_.commands.empty());
}

TEST_F(Explaining, AnOrdinaryEpisodeIsExplainedToo) {
  Deployment deployment("explain_episode");
  ASSERT_TRUE(deployment.Up(witness_, 1));
  auto& executive = deployment.Executive();
  int code = -1;
  ASSERT_TRUE(witness_.Until([&] { return (code = executive.Wait(0)) >= 0; }, kEpisodeMs));
  const auto result = deployment.Result();
  ASSERT_FALSE(result.at("acts").empty());
  EXPECT_TRUE(Holds(Page(deployment),
                    "Act: begin with " + result.at("acts").at(0).at("name").get<std::string>()));
}

TEST_F(Explaining, ANamedPlanIsJudgedByTheModel) {
  Deployment deployment("explain_what_if");
  ASSERT_TRUE(deployment.Up(witness_, 2));
  ASSERT_EQ(Explain(deployment, {}), 0);
  const auto chosen = Chosen(deployment);
  ASSERT_EQ(chosen.size(), 3u);
  const double score = deployment.Result().at("searches").at(0).at("score");

  // That plan itself: the model servers say the same of it again. The search beside it may come to
  // another one, as the order in which answers arrive differs: then the two are compared.
  ASSERT_EQ(Explain(deployment, {"--what-if", chosen[0] + "," + chosen[1] + ", " + chosen[2]}), 0);
  auto what_if = deployment.Result().at("what_if");
  const std::string finding = what_if.at("findings").at(0);
  EXPECT_FALSE(finding.empty());
  EXPECT_EQ(finding == "It is the chosen plan.", Chosen(deployment) == chosen) << finding;
  EXPECT_NEAR(what_if.at("score").get<double>(), score, 1e-6);
  EXPECT_EQ(what_if.at("forbidden_step"), 0);
  // Up to what HTML writes otherwise.
  EXPECT_TRUE(Holds(Page(deployment), finding.substr(0, finding.find('\'')))) << finding;

  // Backwards: another plan, with figures of its own at every step.
  ASSERT_EQ(Explain(deployment, {"--what-if", chosen[2] + "," + chosen[1] + "," + chosen[0]}), 0);
  what_if = deployment.Result().at("what_if");
  ASSERT_EQ(what_if.at("steps").size(), 3u);
  for (const auto& step : what_if.at("steps")) EXPECT_TRUE(step.at("imagined").get<bool>());
  double done = 1;
  for (const auto& step : what_if.at("steps")) done *= step.at("f").get<double>();
  EXPECT_NEAR(what_if.at("score").get<double>(),
              done * what_if.at("steps").at(2).at("V").get<double>(), 1e-6);
  EXPECT_EQ(what_if.at("findings").at(0) == "It is the chosen plan.",
            Chosen(deployment) == std::vector<std::string>(chosen.rbegin(), chosen.rend()));
  EXPECT_TRUE(std::filesystem::exists(deployment.folder + "/out/what-if.png"));
}

TEST_F(Explaining, AForbiddenPlanIsShownAsForbidden) {
  Deployment deployment("explain_forbidden");
  ASSERT_TRUE(deployment.Up(witness_, 1));
  ASSERT_EQ(Explain(deployment, {}), 0);
  const std::string first = Chosen(deployment).at(0);
  ASSERT_EQ(Explain(deployment, {"--what-if", first + "," + first}), 0);
  const auto what_if = deployment.Result().at("what_if");
  EXPECT_EQ(what_if.at("forbidden_step"), 2);
  EXPECT_TRUE(what_if.at("steps").at(0).at("imagined").get<bool>());
  EXPECT_FALSE(what_if.at("steps").at(1).at("imagined").get<bool>());
  const std::string finding = what_if.at("findings").back();
  EXPECT_TRUE(Holds(finding, "rules forbid step 2, " + first + ": it was taken before")) << finding;
  EXPECT_TRUE(Holds(Page(deployment), "rules forbid step 2"));
}

TEST_F(Explaining, UnknownAndMalformedNamesEndWithWhatIsAllowed) {
  Deployment deployment("explain_unknown");
  ASSERT_TRUE(deployment.Up(witness_, 1));
  int program = 4;
  for (const char* text : {"jump", "investigate(barrel),", "investigate(barrel"}) {
    EXPECT_EQ(Explain(deployment, {"--what-if", text}), 2) << text;
    const std::string said = deployment.Log(std::to_string(program++) + "-prospect-executive");
    EXPECT_TRUE(Holds(said, "--what-if: ")) << said;
    const bool malformed = text != std::string("jump");
    EXPECT_TRUE(Holds(said, malformed ? "no plan" : "actions: investigate(")) << said;
  }
  EXPECT_TRUE(witness_.roots.empty()) << "nothing should have been searched";
}

TEST_F(Explaining, AFileInTheWayOfThePageIsNamed) {
  Deployment deployment("explain_blocked");
  ASSERT_TRUE(deployment.Up(witness_, 1));
  std::filesystem::create_directories(deployment.folder + "/out/explain.html/in the way");
  EXPECT_EQ(Explain(deployment, {}), 13);
  EXPECT_TRUE(Holds(deployment.Log("4-prospect-executive"), "explain.html"));
}

}  // namespace
}  // namespace prospect::tests
