// What a task file may say, and what is told of each mistake in one.

#include "tasks/task_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "planner/task_rules.h"

namespace prospect::tasks {
namespace {

constexpr char kTable[] =                                // its lines are counted from 1
    "name: sorter\n"                                     // 1
    "picture: {width: 64, height: 48}\n"                 // 2
    "actions:\n"                                         // 3
    "  - open_lid\n"                                     // 4
    "  - pick(cup)\n"                                    // 5
    "  - pick(ball)\n"                                   // 6
    "  - {name: fill, kind: pour water, object: cup}\n"  // 7
    "  - place(cup)\n"                                   // 8
    "  - place(ball)\n"                                  // 9
    "first: open_lid\n"                                  // 10
    "follows:\n"                                         // 11
    "  open_lid: pick\n"                                 // 12
    "  pick: place(same)\n"                              // 13
    "  place: [pick(other), fill]\n"                     // 14
    "  fill: []\n"                                       // 15
    "plan_length: 6\n"                                   // 16
    "repeats_allowed: false\n"                           // 17
    "tick_seconds: 0.1\n"                                // 18
    "action_time_limit: 20\n"                            // 19
    "goals:\n"                                           // 20
    "  placed(A): {by: place(A)}\n"                      // 21
    "causes:\n"                                          // 22
    "  spilled: it spilled the water\n";                 // 23

std::string With(std::string text, const std::string& old, const std::string& changed) {
  const std::size_t at = text.find(old);
  EXPECT_NE(at, std::string::npos) << old;
  return text.replace(at, old.size(), changed);
}

std::string ErrorOf(const std::string& text) {
  try {
    ParseTaskFile(text, "t.yaml");
  } catch (const TaskFileError& error) {
    EXPECT_EQ(error.code(), kExitDataFile);
    return error.what();
  }
  return "";
}

TEST(TaskFile, SaysWhatATableIs) {
  const TaskFile task = ParseTaskFile(kTable, "t.yaml");
  EXPECT_EQ(task.spec.name, "sorter");
  EXPECT_EQ(task.spec.image_height, 48);
  ASSERT_EQ(task.spec.actions.size(), 6u);
  EXPECT_EQ(task.spec.actions[1].kind, "pick");
  EXPECT_EQ(task.spec.actions[1].object, "cup");
  EXPECT_EQ(task.spec.actions[0].kind, "open_lid");
  EXPECT_EQ(task.spec.actions[0].object, "");
  EXPECT_EQ(task.spec.actions[3].kind, "pour water");
  const std::vector<std::vector<int>> rows{{1, 2}, {4}, {5}, {}, {2, 3}, {1, 3}, {0}};
  EXPECT_EQ(task.spec.successors, rows);
  EXPECT_EQ(task.spec.causes.at(0).words, "it spilled the water");
  EXPECT_FALSE(task.usual);
  EXPECT_FALSE(task.simulator);
  planner::TaskRules rules = task.Rules();
  rules.Prepare();
  EXPECT_TRUE(rules.Legal({}, {0, 1, 4, 2, 5, 3}));
}

TEST(TaskFile, RetryLetsAPlanBeginAnew) {
  const TaskFile task = ParseTaskFile(std::string(kTable) + "retry: place(cup)\n", "t.yaml");
  EXPECT_EQ(task.spec.successors[4], (std::vector<int>{0, 2, 3}));
}

TEST(TaskFile, GoalsAreFactsOfAllObjectsThatCanHaveThem) {
  const std::string text =
      With(kTable, "  placed(A): {by: place(A)}\n",
           "  first_to(A,B): {by: place(A) then pick(B), undone_by: [fill]}\n");
  const TaskFile task = ParseTaskFile(text, "t.yaml");
  ASSERT_EQ(task.goals.size(), 2u);
  const planner::GoalFact expected{"first_to", {"cup", "ball"}, {{4, 2}}, {{-1, 3}}};
  EXPECT_EQ(task.goals[0], expected);
}

struct Mistake {
  const char* old;
  std::string changed;
  const char* place;  // "t.yaml:LINE: "
  const char* said;   // a part of the rest
};

std::string Rows(int count) {
  std::string rows;
  for (int i = 0; i < count; ++i) rows += "  - a" + std::to_string(i) + "\n";
  return rows;
}

const char* const kActions =
    "  - open_lid\n  - pick(cup)\n  - pick(ball)\n  - {name: fill, kind: pour water, object: cup}\n"
    "  - place(cup)\n  - place(ball)\n";

std::vector<Mistake> Mistakes() {
  return {
      {"plan_length", "plan_lenght", "t.yaml:16: ", "did you mean 'plan_length'?"},
      {"name: sorter\n", "", "t.yaml:1: ", "'name' is missing"},
      {"name: sorter", "name: Sorter", "t.yaml:1: ", "lower-case letters"},
      {"name: sorter", "name: ../up", "t.yaml:1: ", "has the character .: use"},
      {"name: sorter", "name: [a]", "t.yaml:1: ", "is no text"},
      {"width: 64", "width: 63", "t.yaml:2: ", "picture.width is 63: give a multiple of 16"},
      {"height: 48", "height: 512", "t.yaml:2: ", "picture.height is '512'"},
      {"height: 48", "hight: 48", "t.yaml:2: ", "did you mean 'picture.height'?"},
      {"{width: 64, height: 48}", "64", "t.yaml:2: ", "must be a map"},
      {kActions, "  []\n", "t.yaml:4: ", "there are 0: name 1 to 255"},
      {kActions, Rows(300), "t.yaml:4: ", "there are 300: name 1 to 255"},
      {"open_lid", "pick(cup)", "t.yaml:5: ", "two actions 'pick(cup)'"},
      {"- open_lid", "- open the lid", "t.yaml:4: ", "has a space: use letters"},
      {"- open_lid", "- open\"lid\"", "t.yaml:4: ", "has the character \""},
      {"- open_lid", "- <b>lid</b>", "t.yaml:4: ", "has the character <"},
      {"- open_lid", "- " + std::string(10240, 'x'), "t.yaml:4: ", "has 10240 characters"},
      {"- open_lid", "- open(lid", "t.yaml:4: ", "is not of the form"},
      {"- open_lid", "- any", "t.yaml:4: ", "is a word of the rules"},
      {"kind: pour water", "kind: <i>", "t.yaml:7: ", "the kind '<i>' has the character <"},
      {"kind: pour water", "knid: pour", "t.yaml:7: ", "did you mean 'action.kind'?"},
      {"open_lid: pick", "open_lid: pik", "t.yaml:12: ", "did you mean 'pick'?"},
      {"open_lid: pick", "open_lip: pick", "t.yaml:12: ", "did you mean 'open_lid'?"},
      {"pick: place(same)", "pick: dance", "t.yaml:13: ", "there is no action or kind 'dance'"},
      {"first: open_lid", "first: place(same)", "t.yaml:10: ", "write place(any)"},
      {"first: open_lid", "first: []", "t.yaml:10: ", "names no action"},
      {"first: open_lid\n", "", "t.yaml:1: ", "'first' is missing"},
      {"fill: []", "fill: place(cup)", "t.yaml:12: ", "after 'open_lid' no plan can be complete"},
      {"plan_length: 6", "plan_length: 0", "t.yaml:16: ", "a whole number from 1 to"},
      {"plan_length: 6", "plan_length: 65", "t.yaml:16: ", "a whole number from 1 to 64"},
      {"plan_length: 6", "plan_length: 2", "t.yaml:16: ", "they have 4, 6, 8"},
      {"plan_length: 6", "plan_length: 8", "t.yaml:16: ", "without repeating one of 6"},
      {"repeats_allowed: false", "repeats_allowed: maybe", "t.yaml:17: ", "true nor false"},
      {"tick_seconds: 0.1", "tick_seconds: -1", "t.yaml:18: ", "above 0, at most 10"},
      {"tick_seconds: 0.1", "tick_seconds: fast", "t.yaml:18: ", "above 0, at most 10"},
      {"action_time_limit: 20", "action_time_limit: .nan", "t.yaml:19: ", "at most 3600"},
      {"action_time_limit: 20", "action_time_limit: [1, 2]", "t.yaml:19: ", "one for each"},
      {"by: place(A)", "by: plaec(A)", "t.yaml:21: ", "did you mean 'place'?"},
      {"by: place(A)", "by: place(A) then place(A)", "t.yaml:21: ", "no plan can bring"},
      {"placed(A)", "placed", "t.yaml:21: ", "is not of the form on(A,B)"},
      {"{by: place(A)}", "{}", "t.yaml:21: ", "'goals.placed(A).by' is missing"},
      {"spilled: it", "spilled: <b>it", "t.yaml:23: ", "has the character <"},
      {"spilled: it spilled the water", "spilled: ''", "t.yaml:23: ", "is empty: name it"},
      {"name: sorter", "name: sorter\nname: sorter", "t.yaml:2: ", "'name' is there twice"},
      {"name: sorter", "name: {sorter", "t.yaml:", "is no YAML"},
      {kTable, "", "t.yaml:1: ", "the file must be a map"},
      {kTable, "- 1\n", "t.yaml:1: ", "the file must be a map"},
      {"name: sorter", "training: {network: {dropout: 1, dropout: 2}}\nname: sorter",
       "t.yaml:1: ", "'dropout' is there twice"},
      {"name: sorter", "simulator: {scene: {towers: 2}}\nname: sorter",
       "t.yaml:1: ", "did you mean 'simulator.scene.tower'?"},
  };
}

TEST(TaskFile, EachMistakeIsToldInOneLineWithItsPlaceAndARemedy) {
  for (const Mistake& mistake : Mistakes()) {
    const std::string said = ErrorOf(With(kTable, mistake.old, mistake.changed));
    EXPECT_TRUE(said.starts_with(mistake.place)) << mistake.changed.substr(0, 80) << "\n" << said;
    EXPECT_NE(said.find(mistake.said), std::string::npos) << mistake.said << "\n" << said;
    EXPECT_EQ(said.find('\n'), std::string::npos) << said;
    EXPECT_LT(said.size(), 300u) << said;
  }
}

TEST(TaskFile, ACircleWithoutAnEndIsNamed) {
  const std::string text = With(With(kTable, "  fill: []\n", "  fill: stir\n  stir: fill\n"),
                                "  - place(ball)\n", "  - place(ball)\n  - stir\n");
  const std::string said = ErrorOf(text);
  EXPECT_NE(said.find("no plan can be complete, it goes round ("), std::string::npos) << said;
}

TEST(TaskFile, NoPlanWithoutARepeat) {
  const std::string said = ErrorOf(With(With(kTable, "plan_length: 6", "plan_length: 5"),
                                        "pick: place(same)", "pick: [place(same), pick(same)]"));
  EXPECT_NE(said.find("shorten it, or say 'repeats_allowed: true'"), std::string::npos) << said;
}

TEST(TaskFile, AFileThatIsNotThere) {
  EXPECT_THROW(ReadTaskFile("/nowhere/at/all.yaml"), TaskFileError);
  EXPECT_THROW(ReadTaskFile("/"), TaskFileError);
}

TEST(TaskFile, TooLargeOrDeepFilesAreRefused) {
  EXPECT_NE(ErrorOf(std::string(1 << 20, '#')).find("bytes"), std::string::npos);
  EXPECT_NE(ErrorOf("name: " + std::string(20000, '[')).find("t.yaml:"), std::string::npos);
  EXPECT_NE(ErrorOf("training: {a: {b: {c: {d: 1}}}}\n" + std::string(kTable)), "");
}

}  // namespace
}  // namespace prospect::tasks
