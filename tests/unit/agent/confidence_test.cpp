#include "agent/confidence.h"

#include <gtest/gtest.h>

#include "tests/unit/agent/calibration_sample.h"

namespace prospect::agent {
namespace {

bool Holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(Confidence, CountsScenesOfLikeScore) {
  const auto sure = ConfidenceOf(Sample(), 0.84, 0);
  ASSERT_TRUE(sure);
  EXPECT_GE(sure->scenes, 20);
  EXPECT_GE(sure->share(), 0.8);
  const auto unsure = ConfidenceOf(Sample(), 0.21, 0);
  ASSERT_TRUE(unsure);
  EXPECT_EQ(unsure->scenes, 30);
  EXPECT_EQ(unsure->solved, 10);
  EXPECT_EQ(SuccessSentence(*unsure),
            "Succeeds in about 33 %: of 30 calibration scenes whose plan scored 0.200 to 0.229, "
            "10 were solved.");
}

TEST(Confidence, IsNotHadWhereNobodyCounted) {
  EXPECT_FALSE(ConfidenceOf({}, 0.5, 0));
  EXPECT_FALSE(ConfidenceOf(Sample(), 0.9, 0)) << "above every score";
  EXPECT_FALSE(ConfidenceOf(Sample(), 0.199, 0)) << "below every score";
  EXPECT_FALSE(ConfidenceOf(Sample(), 0.21, 0.9)) << "no scene is attempted";
}

// Scenes that the threshold would have refused say nothing of those that are attempted.
TEST(Confidence, CountsNoSceneBelowTheThreshold) {
  const auto confidence = ConfidenceOf(Sample(), 0.825, 0.8195);
  ASSERT_TRUE(confidence);
  EXPECT_GE(confidence->low, 0.8195);
  EXPECT_EQ(confidence->scenes, 30);
}

TEST(RefusalTerms, SayWhatTheCalibrationDoesNotCover) {
  EXPECT_EQ(TermsOf(Sample(), "paper", {{"samples", 30}}, false).caveat, "");
  EXPECT_EQ(TermsOf(Sample(), "paper", {}, false).sample, 80);
  EXPECT_EQ(TermsOf(Sample(), "puct", {{"samples", 10}}, true).caveat,
            "The calibration does not cover this search: rule puct instead of paper, samples 10 "
            "instead of 30, a goal, where the calibration had the task's own.");
}

TEST(ConfidenceSentences, TellSuccessPromisesAndCaveat) {
  RefusalTerms terms = TermsOf(Sample(), "paper", {}, true);
  terms.promises = {"Refuses at most 5 %."};
  auto sentences = ConfidenceSentences(ConfidenceOf(Sample(), 0.21, 0), terms);
  ASSERT_EQ(sentences.size(), 3u);
  EXPECT_TRUE(Holds(sentences[0], "Succeeds in about 33 %"));
  EXPECT_EQ(sentences[1], "Refuses at most 5 %.");
  EXPECT_TRUE(Holds(sentences[2], "does not cover"));
  sentences = ConfidenceSentences(std::nullopt, terms);
  EXPECT_EQ(sentences.size(), 2u) << "the promise and its caveat";
  terms.promises.clear();
  EXPECT_TRUE(ConfidenceSentences(std::nullopt, terms).empty()) << "a caveat to nothing";
  EXPECT_TRUE(ConfidenceSentences(std::nullopt, std::nullopt).empty());
}

}  // namespace
}  // namespace prospect::agent
