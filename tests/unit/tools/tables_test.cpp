// The paper's tables: which examples count, how they are scored, and what the table says of them.

#include <gtest/gtest.h>

#include <fstream>

#include "tests/unit/model/made_trial.h"
#include "tests/unit/model/test_folder.h"
#include "tools/tables/bootstrap.h"
#include "tools/tables/examples.h"
#include "tools/tables/report.h"
#include "tools/tables/row_cache.h"
#include "tools/tables/scorer.h"

namespace prospect::tools {
namespace {

using model::MadeTrial;

// Segments of the made trial: 0 is frames 1 to 4, 1 is 5 to 8, 2 is 9 to 12; frame 0 comes before.
TEST(Examples, AreTheFramesThatHaveASecondAction) {
  const model::Trial trial = MadeTrial(0, 3);
  const std::vector<Example> all = ExamplesOf(trial, 1, false);
  ASSERT_EQ(all.size(), 8U);
  EXPECT_EQ(all.front().frame, 1);
  EXPECT_EQ(all.front().action1, trial.actions[1]);
  EXPECT_EQ(all.front().goal1, 5) << "the frame on which the next action begins";
  EXPECT_EQ(all.front().action2, trial.actions[5]);
  EXPECT_EQ(all.front().goal2, 9);
  EXPECT_EQ(all.back().frame, 8);
  EXPECT_EQ(all.back().goal1, 9);
  EXPECT_EQ(all.back().goal2, 12) << "the trial's last frame";
}

TEST(Examples, ThePapersTailTakesTheLastActionTwice) {
  const std::vector<Example> all = ExamplesOf(MadeTrial(0, 3), 1, true);
  ASSERT_EQ(all.size(), 12U);
  EXPECT_EQ(all.back().action2, all.back().action1);
  EXPECT_EQ(all.back().goal2, 12);
  EXPECT_EQ(all.back().goal1, 12);
}

TEST(Examples, CanBeThinnedOut) {
  const std::vector<Example> all = ExamplesOf(MadeTrial(0, 3), 3, false);
  ASSERT_EQ(all.size(), 3U);
  EXPECT_EQ(all[1].frame, 4);
  EXPECT_EQ(all[2].frame, 7);
}

TEST(Examples, ATrialOfOneActionHasNone) {
  EXPECT_TRUE(ExamplesOf(MadeTrial(0, 1), 1, false).empty());
  EXPECT_TRUE(ExamplesOf(MadeTrial(0, 0), 1, true).empty());
}

TrialSums SumsOf(double examples, double error_each) {
  TrialSums sums;
  sums.examples = sums.labelled = examples;
  sums.sum[kX1Error] = examples * error_each;
  return sums;
}

TEST(Bootstrap, WeighsEveryExampleAlike) {
  const Estimate e = Bootstrap({SumsOf(30, 0.1), SumsOf(10, 0.5)}, kX1Error);
  EXPECT_NEAR(e.value, 0.2, 1e-12);
  EXPECT_EQ(e.examples, 40);
  EXPECT_NEAR(e.low, 0.1, 1e-9) << "two trials: the first twice is not rare";
  EXPECT_NEAR(e.high, 0.5, 1e-9);
}

TEST(Bootstrap, HasNoWidthWhereTrialsAgreeAndShrinksWithMoreTrials) {
  const Estimate same = Bootstrap(std::vector<TrialSums>(20, SumsOf(7, 0.25)), kX1Error);
  EXPECT_NEAR(same.low, 0.25, 1e-12);
  EXPECT_NEAR(same.high, 0.25, 1e-12);
  const auto width = [](int trials) {
    std::vector<TrialSums> all;
    for (int i = 0; i < trials; ++i) all.push_back(SumsOf(10, i % 2 == 0 ? 0.0 : 1.0));
    const Estimate e = Bootstrap(all, kX1Error);
    return e.high - e.low;
  };
  EXPECT_NEAR(width(400), 4 * 0.5 / 20, 0.02) << "the binomial's two standard deviations";
  EXPECT_GT(width(25), 3 * width(400));
}

TEST(Bootstrap, OfNothingIsNothing) {
  EXPECT_EQ(Bootstrap({}, kX1Error).examples, 0);
  EXPECT_EQ(Bootstrap({TrialSums()}, kX1Error).value, 0);
}

// One model is 0.01 worse on every trial, though trials differ by far more than that.
TEST(Bootstrap, ADifferenceIsTakenTrialByTrial) {
  std::vector<TrialSums> one, other;
  for (int i = 0; i < 30; ++i) {
    one.push_back(SumsOf(10, 0.1 * (i % 3) + 0.01));
    other.push_back(SumsOf(10, 0.1 * (i % 3)));
  }
  const Estimate difference = BootstrapDifference(one, other, kX1Error);
  EXPECT_NEAR(difference.value, 0.01, 1e-12);
  EXPECT_NEAR(difference.low, 0.01, 1e-12);
  EXPECT_NEAR(difference.high, 0.01, 1e-12);
  const Estimate alone = Bootstrap(one, kX1Error);
  EXPECT_GT(alone.high - alone.low, 0.04);
  other.pop_back();
  EXPECT_THROW(BootstrapDifference(one, other, kX1Error), std::invalid_argument);
  EXPECT_EQ(BootstrapDifference({}, {}, kX1Error).examples, 0);
}

Row RowOf(double error_of_success, double error_of_failure) {
  Row row;
  row.trials.push_back({1, true, SumsOf(10, error_of_success)});
  row.trials.push_back({2, false, SumsOf(30, error_of_failure)});
  return row;
}

TEST(Report, SuccessfulTrialsAloneOrAll) {
  Line line{"L1", RowOf(0.1, 0.2), true, 6600, 123.4};
  const std::string successful = MarkdownTable({line}, true);
  EXPECT_NE(successful.find("| L1 | 0.0 [0.0, 0.0] | 0.1000 [0.1000, 0.1000] |"), std::string::npos)
      << successful;
  EXPECT_NE(successful.find("| 10 | 6600 | 123 |"), std::string::npos) << successful;
  const std::string all = MarkdownTable({line}, false);
  EXPECT_NE(all.find("0.1750 ["), std::string::npos) << all;
  EXPECT_NE(all.find("| 40 | 6600 | 123 |"), std::string::npos) << all;
}

TEST(Report, SaysWhatWasNotTrained) {
  const Line line{"cGAN", std::nullopt, true};
  const std::string table = MarkdownTable({line}, false);
  EXPECT_NE(table.find("| cGAN |"), std::string::npos);
  EXPECT_NE(table.find("not trained"), std::string::npos);
}

TEST(Report, TellsHowModelsDiffer) {
  const Line copy{"copy x", RowOf(0.5, 0.5)}, l1{"L1", RowOf(0.1, 0.2), true},
      skipless{"No Skips", RowOf(0.15, 0.2), true}, absent{"cGAN", std::nullopt, true};
  const std::string table = DifferencesTable({copy, l1, skipless, absent}, l1);
  EXPECT_NE(table.find("| No Skips | +0.0 [+0.0, +0.0] | +0.0500 [+0.0500, +0.0500] |"),
            std::string::npos)
      << table;
  EXPECT_NE(table.find("| +0.0125 ["), std::string::npos) << "of all 40 examples";
  EXPECT_EQ(table.find("copy"), std::string::npos);
  EXPECT_EQ(table.find("cGAN"), std::string::npos);
  EXPECT_EQ(DifferencesTable({copy, l1, absent}, l1), "");
}

std::size_t Fields(const std::string& line) {
  return static_cast<std::size_t>(std::count(line.begin(), line.end(), ',')) + 1;
}

TEST(Report, EveryLineOfTheCsvHasAllFields) {
  const std::string csv = CsvTables({{"copy x", RowOf(0.1, 0.2)},
                                     {"L1", RowOf(0.1, 0.2), true, 6600, 0},
                                     {"cGAN", std::nullopt, true}});
  std::istringstream in(csv);
  std::string heading, line;
  std::getline(in, heading);
  int lines = 0;
  for (; std::getline(in, line); ++lines) EXPECT_EQ(Fields(line), Fields(heading)) << line;
  EXPECT_EQ(lines, 6);
}

class TablesTest : public ::testing::Test {
 protected:
  model::TestFolder folder_;
};

TEST_F(TablesTest, ARowIsMadeOnceAndAnewWhenItsKeyChanges) {
  const std::string path = folder_ / "row.json";
  int made = 0;
  const auto make = [&] {
    ++made;
    return std::vector<Row>{RowOf(0.1, 0.25)};
  };
  CachedRows(path, "a", make);
  const std::vector<Row> again = CachedRows(path, "a", make);
  EXPECT_EQ(made, 1);
  ASSERT_EQ(again.size(), 1U);
  EXPECT_EQ(again[0].trials[1].seed, 2U);
  EXPECT_FALSE(again[0].trials[1].succeeded);
  EXPECT_DOUBLE_EQ(again[0].trials[1].sums.sum[kX1Error], 7.5);
  CachedRows(path, "b", make);
  EXPECT_EQ(made, 2);
  std::ofstream(path) << "damaged";
  CachedRows(path, "b", make);
  EXPECT_EQ(made, 3);
}

// Networks of random weights: what is checked is what they are compared with.
class ScorerTest : public TablesTest {
 protected:
  ScorerTest() : networks_(Config()) {
    std::vector<std::string> parts;
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
      if (model::SplitOf(seed) != model::Split::kTest) continue;
      parts.push_back(folder_ / (std::to_string(seed) + ".h5"));
      model::Trial trial = MadeTrial(seed, 3, seed % 2 == 0, 4, 32);
      trial.image_noise = 0.02;
      model::WriteTrialFile(parts.back(), trial);
    }
    data_.path = folder_ / "all.h5";
    trials_ = model::PackTrialFiles(parts, data_.path);
    networks_.SetTraining(false);
  }
  static model::NetworkConfig Config() {
    model::NetworkConfig config;
    config.image_width = config.image_height = 32;
    config.num_actions = 3;
    torch::manual_seed(1);
    return config;
  }
  static TrialSums Total(const Row& row) {
    TrialSums total;
    for (const Row::Trial& trial : row.trials) total.Add(trial.sums);
    return total;
  }
  TableData data_;
  std::size_t trials_ = 0;
  model::Networks networks_;
};

TEST_F(ScorerTest, BaselinesAreMeasuredAgainstTheCleanGoals) {
  const Baselines rows =
      ScoreBaselines(data_, networks_, networks_.second_classifier, [](int, int) {});
  ASSERT_EQ(rows.goal.trials.size(), trials_);
  const TrialSums goal = Total(rows.goal), copy = Total(rows.copy);
  EXPECT_EQ(goal.examples, 8.0 * static_cast<double>(trials_));
  // The mean of |N(0, sigma)| is 0.8 sigma; rounding to 8 bits and clamping change it little.
  EXPECT_NEAR(goal.sum[kX1Error] / goal.examples, 0.8 * 0.02, 0.002);
  // The square has moved: two cells of 64 differ, each in one colour, and the noise comes on top.
  EXPECT_GT(copy.sum[kX1Error], 1.2 * goal.sum[kX1Error]);
  EXPECT_GE(rows.goal.trials[0].sums.sum[kX1Label], 0);
}

TEST_F(ScorerTest, AModelsRowHasAllColumnsAndDoesNotDependOnThreads) {
  const auto score = [&](int threads) {
    data_.threads = threads;
    return Total(ScoreModel(data_, networks_, networks_.second_classifier, [](int, int) {}));
  };
  const TrialSums one = score(1), two = score(2);
  EXPECT_EQ(one.sum, two.sum);
  EXPECT_EQ(one.examples, 8.0 * static_cast<double>(trials_));
  EXPECT_EQ(one.extras, 2.0 * static_cast<double>(trials_)) << "every fifth of eight";
  for (const Column column : {kX1Error, kX2Error, kX1Composed, kX2Composed}) {
    EXPECT_GT(one.sum[column], 0) << column;
  }
}

// An untrained judge says one label of everything: exactly the examples of that action are hits.
TEST_F(ScorerTest, LabelsAreThoseOfTheActions) {
  model::Classifier judge = networks_.second_classifier;
  const torch::NoGradGuard no_grad;
  for (torch::Tensor& tensor : judge->parameters()) tensor.zero_();
  judge->named_parameters()["out.bias"][1] = 1.0;
  double first = 0, second = 0;
  const model::TrialFile file(data_.path);
  for (std::size_t i = 0; i < file.size(); ++i) {
    for (const Example& e : ExamplesOf(file.ReadLabels(i), 1, false)) {
      first += e.action1 == 1;
      second += e.action2 == 1;
    }
  }
  ASSERT_GT(first, 0);
  ASSERT_NE(first, second);
  const TrialSums sums = Total(ScoreModel(data_, networks_, judge, [](int, int) {}));
  EXPECT_EQ(sums.sum[kX1Label], first);
  EXPECT_EQ(sums.sum[kX2Label], second);
}

TEST_F(ScorerTest, ADataSetWithoutTestTrialsIsRefused) {
  std::uint64_t seed = 0;
  while (model::SplitOf(seed) == model::Split::kTest) ++seed;
  model::WriteTrialFile(folder_ / "one.h5", MadeTrial(seed, 3, false, 4, 32));
  data_.path = folder_ / "one.h5";
  EXPECT_THROW(ScoreModel(data_, networks_, networks_.second_classifier, [](int, int) {}),
               model::DataError);
}

}  // namespace
}  // namespace prospect::tools
