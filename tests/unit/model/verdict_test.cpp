#include "model/training/verdict.h"

#include <gtest/gtest.h>

namespace prospect::model {
namespace {

nlohmann::json Head(double right, double brier, double rate = 0.5, int samples = 1000) {
  return {{"balanced_accuracy", right},
          {"brier", brier},
          {"trivial_brier", rate * (1 - rate)},
          {"base_rate", rate},
          {"samples", samples}};
}

nlohmann::json Scores(const nlohmann::json& f) {
  const auto good = nlohmann::json{{"imagined", Head(0.9, 0.1)}};
  const nlohmann::json picture{{"mae_changed", 0.06}, {"copy_mae_changed", 0.3}};
  return {{"trials", 40},
          {"pictures", {{"x1", picture}, {"x2", picture}}},
          {"value", good},
          {"f", {{"imagined", f}}},
          {"p", good},
          {"q", good},
          {"plan", Head(0.9, 0.1)}};
}

bool Says(const nlohmann::json& scores, const std::string& words) {
  return Verdict(scores).find(words) != std::string::npos;
}

TEST(Verdict, LearnedWellIsSaidInWords) {
  const auto scores = Scores(Head(0.9, 0.1));
  EXPECT_TRUE(Says(scores, "80 % less than an unchanged picture")) << Verdict(scores);
  EXPECT_TRUE(Says(scores, "its numbers are 60 % closer than always saying 0.50"));
  EXPECT_TRUE(Says(scores, "Everything was learned better than the trivial answer."));
}

TEST(Verdict, GuessingIsNamed) {
  EXPECT_TRUE(Says(Scores(Head(0.51, 0.26)), "NOT better than guessing"));
  EXPECT_TRUE(Says(Scores(Head(0.40, 0.30)), "WORSE than guessing"));
  EXPECT_TRUE(Says(Scores(Head(0.51, 0.26)), "Not shown to be learned: f, will the action"));
}

TEST(Verdict, FewCasesDoNotShowIt) {
  EXPECT_TRUE(Says(Scores(Head(0.7, 0.2, 0.5, 8)), "NOT better than guessing"));
  EXPECT_TRUE(Says(Scores(Head(0.7, 0.2, 0.5, 800)), "Everything was learned"));
}

TEST(Verdict, OneKindOfCaseCannotBeJudged) {
  EXPECT_TRUE(Says(Scores(Head(0.5, 0.0, 1.0)), "cannot be told"));
}

TEST(Verdict, NumbersThatAreOffAreNamed) {
  EXPECT_TRUE(Says(Scores(Head(0.8, 0.3)), "always saying 0.50 is as close"));
}

TEST(Verdict, WeightsOfPicturesAloneAreJudgedByThese) {
  auto scores = Scores(Head(0.9, 0.1));
  for (const char* head : {"value", "f", "p", "q", "plan"}) scores.erase(head);
  EXPECT_FALSE(Says(scores, "V, will it"));
  scores["pictures"]["x2"]["mae_changed"] = 0.31;
  EXPECT_TRUE(Says(scores, "NOT better than an unchanged picture"));
}

}  // namespace
}  // namespace prospect::model
