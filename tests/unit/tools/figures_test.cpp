#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/sensor_noise.h"
#include "model/scripted_engine.h"
#include "sim/stacking/action_table.h"
#include "tests/unit/model/made_trial.h"
#include "tests/unit/model/test_folder.h"
#include "tools/figures/calibration.h"
#include "tools/figures/cells.h"
#include "tools/figures/futures.h"
#include "tools/figures/hidden_states.h"
#include "tools/figures/imagined.h"
#include "tools/figures/search.h"
#include "tools/figures/variants.h"

namespace prospect::figures {
namespace {

using model::TestFolder;

// --- held-out trials

// Seeds of one part of the data, ascending.
std::vector<std::uint64_t> SeedsOf(model::Split split, std::size_t count) {
  std::vector<std::uint64_t> seeds;
  for (std::uint64_t seed = 0; seeds.size() < count; ++seed) {
    if (model::SplitOf(seed) == split) seeds.push_back(seed);
  }
  return seeds;
}

std::string Packed(const TestFolder& folder, const std::vector<model::Trial>& trials) {
  std::vector<std::string> parts;
  for (const model::Trial& trial : trials) {
    parts.push_back(folder / (std::to_string(trial.seed) + ".h5"));
    model::WriteTrialFile(parts.back(), trial);
  }
  model::PackTrialFiles(parts, folder / "data.h5");
  return folder / "data.h5";
}

TEST(HeldOut, ReadsTestTrialsOnlyWithTheCamerasNoise) {
  const TestFolder folder;
  const auto test = SeedsOf(model::Split::kTest, 2);
  const auto train = SeedsOf(model::Split::kTrain, 2);
  std::vector<model::Trial> trials;
  for (const std::uint64_t seed : {test[0], test[1], train[0], train[1]}) {
    trials.push_back(model::MadeTrial(seed));
    trials.back().image_noise = 0.05;
  }
  const HeldOut held_out(Packed(folder, trials));
  ASSERT_EQ(held_out.size(), 2U);
  EXPECT_EQ(held_out.Labels(0).seed, test[0]);
  const SeenTrial trial = held_out.Read(1);
  EXPECT_EQ(trial.labels.seed, test[1]);
  ASSERT_EQ(trial.segments().size(), 2U);
  ASSERT_EQ(trial.seen.size(), trial.samples.frames.size());
  const auto slot = static_cast<std::size_t>(trial.segments()[1].goal);
  const int frame = trial.samples.frames[slot].frame;
  EXPECT_EQ(frame, trials[1].frames() - 1);
  std::vector<std::uint8_t> pixels(trials[1].frame(frame),
                                   trials[1].frame(frame) + trials[1].frame_bytes());
  EXPECT_EQ(trial.clean[slot].rgb, pixels);
  base::AddSensorNoise(pixels.data(), pixels.size(), test[1], frame, 0.05);
  EXPECT_EQ(trial.seen[slot].rgb, pixels);
  EXPECT_NE(trial.seen[slot].rgb, trial.clean[slot].rgb);
}

TEST(HeldOut, WithoutTestTrialsThereIsNothingToShow) {
  const TestFolder folder;
  const auto train = SeedsOf(model::Split::kTrain, 1);
  EXPECT_THROW(HeldOut(Packed(folder, {model::MadeTrial(train[0])})), model::DataError);
  EXPECT_THROW(HeldOut(folder / "missing.h5"), model::DataError);
}

TEST(HeldOut, OrdersAreRepeatableAndWhole) {
  const TestFolder folder;
  std::vector<model::Trial> trials;
  for (const std::uint64_t seed : SeedsOf(model::Split::kTest, 12)) {
    trials.push_back(model::MadeTrial(seed));
  }
  const HeldOut held_out(Packed(folder, trials));
  const auto order = held_out.Shuffled(3);
  EXPECT_EQ(order, held_out.Shuffled(3));
  EXPECT_NE(order, held_out.Shuffled(4));
  EXPECT_EQ(std::set<std::size_t>(order.begin(), order.end()).size(), 12U);
  EXPECT_EQ(held_out.Spread(3), (std::vector<std::size_t>{0, 4, 8}));
  EXPECT_EQ(held_out.Spread(100).size(), 12U);
}

// --- what the task allows

TEST(TaskTable, NamesAreForPeople) {
  const TaskTable table = TableOf("stacking");
  const int align_over = sim::StackingIndex(sim::StackingKind::kAlignOver, 0, 4);
  EXPECT_EQ(table.Name(align_over).rfind("align over ", 0), 0U) << table.Name(align_over);
  EXPECT_THROW(TableOf("cooking"), std::invalid_argument);
}

TEST(TaskTable, PlansAreAsLongAsTheTrials) {
  model::Trial trial = model::MadeTrial(1);
  trial.plan_length = 18;
  const planner::TaskRules rules = TableFor(TableOf("stacking"), trial).rules;
  EXPECT_EQ(rules.plan_length, 18);
  EXPECT_EQ(rules.finishes.size(), 18U) << "prepared for it";
  EXPECT_EQ(rules.AllowedActions({}, {}).size(), 4U);
  trial.plan_length = 0;
  EXPECT_THROW(TableFor(TableOf("stacking"), trial), model::DataError);
}

TEST(TaskTable, OnwardLeavesOutTryingAgain) {
  TaskTable table = TableOf("stacking");
  table.rules.finishes.clear();  // as if the plan could end anywhere
  const auto index = [](sim::StackingKind kind, int block) {
    return static_cast<std::uint8_t>(sim::StackingIndex(kind, block, 4));
  };
  using sim::StackingKind;
  const planner::Path path = {index(StackingKind::kAlign, 0),     index(StackingKind::kGrasp, 0),
                              index(StackingKind::kClose, 0),     index(StackingKind::kLift, 0),
                              index(StackingKind::kAlignOver, 1), index(StackingKind::kStack, 1),
                              index(StackingKind::kOpen, 1)};
  EXPECT_GT(table.rules.AllowedActions({}, path).size(), 1U);
  EXPECT_EQ(table.Onward(path), (std::vector<int>{index(StackingKind::kBackOff, 1)}));
  EXPECT_EQ(table.Onward({}).size(), 4U);
}

TEST(RandomWalk, FollowsTheTasksGraph) {
  const planner::TaskRules rules = TableOf("stacking").rules;
  const std::vector<int> walk = RandomWalk(rules, 200, 5);
  ASSERT_EQ(walk.size(), 200U);
  int before = rules.num_actions;
  for (const int action : walk) {
    const auto& next = rules.successors[static_cast<std::size_t>(before)];
    EXPECT_NE(std::find(next.begin(), next.end(), action), next.end()) << before << " " << action;
    before = action;
  }
  EXPECT_EQ(walk, RandomWalk(rules, 200, 5));
  EXPECT_NE(walk, RandomWalk(rules, 200, 6));
  EXPECT_GT(std::set<int>(walk.begin(), walk.end()).size(), 20U);
}

// --- hidden states

TEST(MeanOverChannels, IsOverChannelsAtEachPlace) {
  model::EngineInfo info;
  info.image_width = 16;
  info.image_height = 8;
  const report::ValueGrid mean = MeanOverChannels(info, {0.F, 1.F, 0.5F, 0.F, 1.F, 0.5F});
  EXPECT_EQ(mean.width, 2);
  EXPECT_EQ(mean.height, 1);
  ASSERT_EQ(mean.values.size(), 2U);
  EXPECT_FLOAT_EQ(mean.values[0], 0.5F);
  EXPECT_FLOAT_EQ(mean.values[1], 0.5F);
}

// --- futures

// Three legs over four actions. Action 3 is forbidden at first, f fails after 0, V falls after 1
// and then 2, p forbids everything after 2 and then 0; the rest is the better the higher its
// actions. Q likes high numbers.
class Fable : public planner::ModelSource {
 public:
  planner::Evaluation Evaluate(const planner::Path& path) override {
    planner::Evaluation e;
    e.value = 0.5F;
    e.done = 0.9F;
    e.q = {0.1F, 0.2F, 0.3F, 0.4F};
    e.p = {1.F, 1.F, 1.F, 1.F};
    if (path.empty()) e.p[3] = 0.F;
    if (path == planner::Path{0}) e.done = 0.01F;
    if (path == planner::Path{1, 2}) e.value = 0.02F;
    if (path == planner::Path{2, 0}) e.p = {0.F, 0.F, 0.F, 0.F};
    if (path.size() == 3) {
      e.value = 0.1F * static_cast<float>(path[0] + path[1] + path[2]) + 0.02F * path[0];
    }
    if (path == planner::Path{1, 0, 2}) e.value = 0.11F;
    return e;
  }
};

TaskTable FableTable() {
  TaskTable table;
  table.rules = planner::AnyOrder(4, 3);
  table.names = {"zero", "one", "two", "three"};
  return table;
}

planner::SearchParameters FableParameters() {
  planner::SearchParameters parameters;
  parameters.samples = 200;
  parameters.v_failed = 0.1;
  parameters.refusal_threshold = 0.09;
  return parameters;
}

const Course* CourseOf(const std::vector<Course>& courses, const planner::Path& path) {
  for (const Course& course : courses) {
    if (course.path == path) return &course;
  }
  return nullptr;
}

TEST(ParallelCourses, EndWhereTheyFailAndBestComesFirst) {
  Fable fable;
  const auto courses = ParallelCourses(FableTable(), &fable, FableParameters());
  ASSERT_EQ(courses.size(), 5U);  // 0 fails at once, so that it is one course and not two
  EXPECT_EQ(courses[0].path, (planner::Path{2, 3, 1}));
  EXPECT_FALSE(courses[0].failed());
  EXPECT_NEAR(courses[0].score, 0.64 * 0.9 * 0.9 * 0.9, 1e-6);
  const Course* undone = CourseOf(courses, {0});
  ASSERT_NE(undone, nullptr);
  EXPECT_EQ(undone->rejection, planner::Rejection::kNotDone);
  const Course* stuck = CourseOf(courses, {2, 0});
  ASSERT_NE(stuck, nullptr);
  EXPECT_TRUE(stuck->stuck);
  const Course* low = CourseOf(courses, {1, 0, 2});
  ASSERT_NE(low, nullptr);
  EXPECT_EQ(low->rejection, planner::Rejection::kLowScore);
  for (const Course& course : courses) EXPECT_NE(course.path.front(), 3);
}

TEST(Cells, FailingStatesAreMarked) {
  planner::SearchParameters parameters;
  parameters.v_failed = 0.1;
  planner::Evaluation good, low, undone;
  good.value = low.done = 0.9F;
  low.value = 0.05F;
  undone.value = 0.9F;
  undone.done = 0.05F;
  const auto cells =
      CellsOf(FableTable(), {0, 1, 2}, {good, low, undone}, std::vector<sim::Image>(3), parameters);
  EXPECT_FALSE(cells[0].bad);
  EXPECT_TRUE(cells[1].bad);
  EXPECT_TRUE(cells[2].bad);
  EXPECT_EQ(cells[0].below, (std::vector<std::string>{"V 0.90"}));
  EXPECT_EQ(cells[2].below, (std::vector<std::string>{"V 0.90", "f 0.05"}));
  EXPECT_EQ(cells[1].above, "2. one");
}

// --- the search

const Tried* TriedOf(const SearchStory& story, const planner::Path& path) {
  for (const Tried& tried : story.tried) {
    if (tried.path == path) return &tried;
  }
  return nullptr;
}

TEST(WatchSearch, TellsWhatBecameOfEachFuture) {
  Fable fable;
  const auto parameters = FableParameters();
  const SearchStory story = WatchSearch(FableTable(), parameters, &fable);
  ASSERT_TRUE(story.plan.ok());
  const std::map<planner::Path, Fate> expected = {
      {{2, 3, 1}, Fate::kChosen},   {{0}, Fate::kNotDone},        {{1, 2}, Fate::kLowValue},
      {{2, 0}, Fate::kAllRefused},  {{1, 0, 2}, Fate::kLowScore}, {{1, 3, 2}, Fate::kPossible},
      {{1, 0, 3}, Fate::kPossible},
  };
  for (const auto& [path, fate] : expected) {
    const Tried* tried = TriedOf(story, path);
    ASSERT_NE(tried, nullptr) << planner::ToString(path);
    EXPECT_EQ(static_cast<int>(tried->fate), static_cast<int>(fate)) << planner::ToString(path);
    EXPECT_EQ(tried->states.size(), path.size());
  }
  for (std::size_t i = 0; i < story.tried.size(); ++i) {
    EXPECT_EQ(story.tried[i].number, static_cast<int>(i) + 1);
    EXPECT_NE(story.tried[i].path.front(), 3) << "never imagined";
  }
  EXPECT_NEAR(TriedOf(story, {2, 3, 1})->score, story.plan.best.score, 1e-9);
}

TEST(WatchSearch, VerdictsGiveStepAndNumbers) {
  Fable fable;
  const auto parameters = FableParameters();
  const SearchStory story = WatchSearch(FableTable(), parameters, &fable);
  const auto verdict = [&](const planner::Path& path) {
    return Verdict(*TriedOf(story, path), story, parameters);
  };
  EXPECT_EQ(verdict({0}), "rejected: step 1 would not finish: f 0.01 < 0.10");
  EXPECT_EQ(verdict({1, 2}), "rejected: V fell at step 2: 0.02 < 0.10");
  EXPECT_EQ(verdict({2, 0}), "rejected: p forbids every action that could follow (p < 0.01)");
  EXPECT_EQ(verdict({1, 0, 2}), "rejected: too unlikely to succeed: score 0.08 < 0.09");
  EXPECT_EQ(verdict({2, 3, 1}), "chosen: score 0.47");
}

TEST(WatchSearch, ShowsThePlanFirstAndEveryFate) {
  Fable fable;
  const SearchStory story = WatchSearch(FableTable(), FableParameters(), &fable);
  const auto shown = ChooseTried(story, 6);
  ASSERT_EQ(shown.size(), 6U);
  EXPECT_EQ(shown[0].fate, Fate::kChosen);
  std::set<Fate> fates;
  for (const Tried& tried : shown) fates.insert(tried.fate);
  EXPECT_EQ(fates.size(), 6U);
  for (std::size_t i = 2; i < shown.size(); ++i) EXPECT_LT(shown[i - 1].number, shown[i].number);
}

TEST(WatchSearch, ARefusalHasNoPlan) {
  Fable fable;
  auto parameters = FableParameters();
  parameters.refusal_threshold = 0.9;
  const SearchStory story = WatchSearch(FableTable(), parameters, &fable);
  EXPECT_FALSE(story.plan.ok());
  for (const Tried& tried : story.tried) EXPECT_NE(tried.fate, Fate::kChosen);
  EXPECT_EQ(TriedOf(story, {2, 3, 1})->fate, Fate::kLowScore);
}

// --- calibration

TEST(Reliability, BinsByPrediction) {
  const auto bins = Reliability(
      {{0.F, false}, {0.05F, true}, {0.15F, false}, {0.95F, true}, {1.F, true}, {0.91F, false}});
  EXPECT_EQ(bins[0].count, 2);
  EXPECT_EQ(bins[0].trues, 1);
  EXPECT_NEAR(bins[0].mean, 0.025, 1e-6);
  EXPECT_EQ(bins[1].count, 1);
  EXPECT_EQ(bins[9].count, 3);
  EXPECT_EQ(bins[9].trues, 2);
  EXPECT_EQ(bins[5].count, 0);
  const double expected = (2 * std::abs(0.025 - 0.5) + 0.15 + std::abs(0.95 + 1 + 0.91 - 2)) / 6;
  EXPECT_NEAR(CalibrationError(bins), expected, 1e-6);
  EXPECT_EQ(CalibrationError(Reliability({})), 0);
}

model::ScriptedOptions MadeOptions() {
  model::ScriptedOptions options;
  options.num_actions = 3;
  options.image_width = options.image_height = 8;
  return options;
}

SeenTrial Seen(const model::Trial& trial) {
  const TestFolder folder;
  const HeldOut held_out(Packed(folder, {trial}));
  return held_out.Read(0);
}

TEST(AddJudgements, HasTheLabelsOfTheTrial) {
  const std::uint64_t seed = SeedsOf(model::Split::kTest, 1)[0];
  const model::Trial made = model::MadeTrial(seed, 3, /*fails=*/true, 8);
  model::ScriptedEngine engine(MadeOptions());
  HeadRecord record;
  AddJudgements(
      Seen(made), &engine,
      [](const model::Hidden&, const model::Hidden&, int action) {
        return action == 1 ? 0.8F : 0.4F;
      },
      &record);
  EXPECT_EQ(record.v[0].size(), 4U);  // the start, and the end of each of three actions
  EXPECT_EQ(record.v[1].size(), 3U);
  EXPECT_EQ(record.v[2].size(), 2U);
  EXPECT_EQ(record.q[0].size(), 3U);  // nothing comes after the last
  EXPECT_EQ(record.q[1].size(), 2U);
  EXPECT_EQ(record.q[2].size(), 1U);
  EXPECT_EQ(record.p[0].size(), 4U * 3);
  EXPECT_EQ(record.p[2].size(), 2U * 3);
  EXPECT_EQ(record.f[0].size(), 3U) << "where plans ask: at ends, not inside of actions";
  const auto trues = [](const model::Judgements& all) {
    return std::count_if(all.begin(), all.end(), [](const auto& j) { return j.truth; });
  };
  EXPECT_EQ(trues(record.v[0]) + trues(record.q[0]), 0);  // the trial failed
  EXPECT_EQ(trues(record.f[0]), 2);                       // and with it its last action
  EXPECT_EQ(trues(record.f[1]), 2);
  EXPECT_EQ(trues(record.f[2]), 1);
  EXPECT_EQ(trues(record.p[0]), 3 + 3 * 2);  // everything at first, then not the same again
}

TEST(AddJudgements, FollowsWhatWasDone) {
  const std::uint64_t seed = SeedsOf(model::Split::kTest, 1)[0];
  const SeenTrial trial = Seen(model::MadeTrial(seed, 3));
  model::ScriptedEngine engine(MadeOptions());
  HeadRecord record;
  AddJudgements(
      trial, &engine, [](const model::Hidden&, const model::Hidden&, int) { return 0.5F; },
      &record);
  const model::Hidden h0 = engine.Encode(trial.seen[0].rgb);
  const int a0 = trial.segments()[0].action, a1 = trial.segments()[1].action;
  const int a2 = trial.segments()[2].action;
  const auto once = engine.Expand({{h0, h0, a0}}).front();
  const auto twice = engine.Expand({{h0, once.h, a1}}).front();
  EXPECT_EQ(record.v[1][0].score, once.value);
  EXPECT_EQ(record.f[1][0].score, once.done);
  EXPECT_EQ(record.q[1][0].score, once.q[static_cast<std::size_t>(a1)]);
  EXPECT_EQ(record.v[2][0].score, twice.value);
  EXPECT_EQ(record.f[2][0].score, twice.done);
  EXPECT_EQ(record.q[2][0].score, twice.q[static_cast<std::size_t>(a2)]);
  EXPECT_TRUE(record.v[2][0].truth);
  EXPECT_EQ(record.q[0][0].score, engine.Evaluate(h0, h0, 3).q[static_cast<std::size_t>(a0)]);
}

// --- variants

TEST(PicturesAlong, FollowsThePathInTheFirstPicturesLight) {
  LoadedModel loaded;
  const auto engine = std::make_shared<model::ScriptedEngine>(MadeOptions());
  loaded.engine = engine;
  std::vector<model::Hidden> painted;
  const sim::Image first{8, 8, std::vector<std::uint8_t>(192, 10)};
  const sim::Image later{8, 8, std::vector<std::uint8_t>(192, 20)};
  int light = 0;
  loaded.paint = [&](const sim::Image& seen, const model::Hidden&,
                     const std::vector<model::Hidden>& states) {
    light = seen.rgb[0];
    painted = states;
    return std::vector<sim::Image>(states.size());
  };
  EXPECT_EQ(PicturesAlong(loaded, first, later, {1, 2}).size(), 2U);
  EXPECT_EQ(light, 10);
  const model::Hidden h = engine->Encode(first.rgb);
  const auto once = engine->Expand({{h, h, 1}}).front().h;
  EXPECT_EQ(painted[0], once);
  EXPECT_EQ(painted[1], engine->Expand({{h, once, 2}}).front().h);
}

TEST(Variants, WhatWasNotTrainedIsNamed) {
  const TestFolder folder;
  const VariantSet variants = LoadVariants(folder.path().string(), "stacking", 1);
  EXPECT_TRUE(variants.trained.empty());
  ASSERT_FALSE(variants.absent.empty());
  EXPECT_EQ(variants.absent.front(), "Naive");
}

TEST(Variants, ExamplesAreTwoActionsOfDifferentKinds) {
  const TestFolder folder;
  std::vector<model::Trial> trials;
  for (const std::uint64_t seed : SeedsOf(model::Split::kTest, 12)) {
    trials.push_back(model::MadeTrial(seed, 3));
  }
  const HeldOut held_out(Packed(folder, trials));
  TaskTable table = FableTable();
  const auto chains = ChooseChains(held_out, table, 3, 1);
  ASSERT_EQ(chains.size(), 3U);
  std::set<int> firsts;
  for (const Chain& chain : chains) {
    ASSERT_LT(static_cast<std::size_t>(chain.first) + 1, chain.trial.segments().size());
    firsts.insert(chain.trial.segments()[static_cast<std::size_t>(chain.first)].action);
  }
  EXPECT_EQ(firsts.size(), 3U);
}

}  // namespace
}  // namespace prospect::figures
