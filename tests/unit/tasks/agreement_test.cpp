// A task file beside what a robot says, and a file made of what it says.

#include "tasks/agreement.h"

#include <gtest/gtest.h>

#include <functional>

#include "tasks/learned.h"
#include "tasks/task_folder.h"

namespace prospect::tasks {
namespace {

const TaskFolder& Folder() {
  static const TaskFolder folder(PROSPECT_ROOT "/tasks");
  return folder;
}

sim::TaskSpec Rover() {
  sim::TaskSpec spec;
  spec.name = "rover";
  spec.actions = {{0, "scan", "scan", ""},
                  {1, "go(hill)", "go", "hill"},
                  {2, "go(lake)", "go", "lake"},
                  {3, "rest", "lie down", "home"}};
  spec.successors = {{1, 2}, {2, 3}, {1, 3}, {}, {0}};
  spec.plan_length = 4;
  spec.image_width = 64;
  spec.image_height = 32;
  spec.tick_seconds = 0.1;
  spec.action_time_limit = 12.5;
  spec.causes = {{"stuck", "it is stuck: \"in mud\", again"}};
  return spec;
}

TEST(Learned, AFileOfWhatIsSaidAgreesWithIt) {
  const sim::TaskSpec said = Rover();
  const TaskFile file = ParseTaskFile(LearnedFile(said), "rover.yaml");
  EXPECT_TRUE(DifferencesOf(file, said).empty()) << InWords(DifferencesOf(file, said), file);
  EXPECT_EQ(file.spec.Hash(), said.Hash());
  ASSERT_EQ(file.spec.causes.size(), 1u);
  EXPECT_EQ(file.spec.causes[0].words, said.causes[0].words);
}

TEST(Learned, SoDoFilesOfTheBuiltInTasks) {
  for (const TaskFile& task : Folder().All()) {
    const TaskFile file = ParseTaskFile(LearnedFile(task.spec), "t.yaml");
    EXPECT_TRUE(DifferencesOf(file, task.spec).empty()) << task.spec.name;
    EXPECT_EQ(file.spec.Hash(), task.spec.Hash()) << task.spec.name;
  }
}

TEST(Learned, WhatCannotStandInAFileIsToBeChangedAtTheRobot) {
  const auto refused = [](const std::function<void(sim::TaskSpec&)>& spoil, const char* what) {
    sim::TaskSpec said = Rover();
    spoil(said);
    try {
      LearnedFile(said);
      ADD_FAILURE() << what;
    } catch (const TaskFileError& error) {
      EXPECT_NE(std::string(error.what()).find(what), std::string::npos) << error.what();
    }
  };
  refused([](auto& said) { said.actions[0].name = "look around"; }, "has a space");
  refused([](auto& said) { said.actions[0].name = "<b>"; }, "change it at the robot");
  refused([](auto& said) { said.name = "The Rover"; }, "the name 'The Rover'");
  refused([](auto& said) { said.image_width = 100; }, "a multiple of 16");
  refused([](auto& said) { said.plan_length = 9; }, "no plan has 9 actions");
  refused([](auto& said) { said.causes[0].words = "<script>"; }, "without tags");
}

struct Change {
  std::function<void(sim::TaskSpec&)> make;
  const char* told;
};

TEST(Agreement, EachDifferenceIsNamedWithBothValues) {
  const TaskFile file = ParseTaskFile(LearnedFile(Rover()), "rover.yaml");
  const std::vector<Change> changes = {
      {[](auto& s) { s.name = "boat"; }, "name is rover in rover.yaml, boat on the bus"},
      {[](auto& s) { s.image_width = 80; }, "picture.width is 64 in rover.yaml, 80 on the bus"},
      {[](auto& s) { s.plan_length = 3; }, "plan_length is 4 in rover.yaml, 3 on the bus"},
      {[](auto& s) { s.repeats_allowed = true; }, "repeats_allowed is false in rover.yaml, true"},
      {[](auto& s) { s.tick_seconds = 0.2; }, "tick_seconds is 0.1 in rover.yaml, 0.2 on the bus"},
      {[](auto& s) { s.action_time_limit = 9; }, "action_time_limit is 12.5 in rover.yaml, 9 on"},
      {[](auto& s) { s.actions[1].name = "go(sea)"; },
       "action 1 is go(hill) in rover.yaml, go(sea)"},
      {[](auto& s) { s.actions[3].kind = "sleep"; }, "action 3's kind is lie down in rover.yaml"},
      {[](auto& s) { s.actions.pop_back(), s.successors.erase(s.successors.begin()); },
       "the number of actions is 4 in rover.yaml, 3 on the bus"},
      {[](auto& s) { s.successors[0] = {1}; },
       "what may follow scan is go(hill), go(lake) in rover.yaml, go(hill) on the bus"},
      {[](auto& s) {
         s.successors[4] = {0, 1};
       },
       "what may come first is scan in rover.yaml, scan, go(hill) on the bus"},
  };
  for (const Change& change : changes) {
    sim::TaskSpec said = Rover();
    change.make(said);
    const std::string words = InWords(DifferencesOf(file, said), file);
    EXPECT_NE(words.find(change.told), std::string::npos) << change.told << "\n" << words;
  }
}

TEST(Agreement, WhatSaysNothingIsNoDifference) {
  const TaskFile file = ParseTaskFile(LearnedFile(Rover()), "rover.yaml");
  sim::TaskSpec said = Rover();
  said.successors[0] = {2, 1, 0};  // itself, where nothing may be repeated; in another order
  said.world_version = "mud";
  EXPECT_TRUE(DifferencesOf(file, said).empty());
}

TEST(Agreement, OfManyDifferencesTheFirstAreTold) {
  const TaskFile file = ParseTaskFile(LearnedFile(Rover()), "rover.yaml");
  sim::TaskSpec said = Rover();
  for (auto& action : said.actions) action.name += "x", action.object += "y";
  const std::string words = InWords(DifferencesOf(file, said), file);
  EXPECT_NE(words.find("; 5 more"), std::string::npos) << words;
  EXPECT_LT(words.size(), 300u);
}

TEST(Agreement, ScenesOfEveryLengthAreTheTasks) {
  const TaskFile& navigation = *Folder().Find("navigation");
  sim::TaskSpec said = navigation.spec;
  for (const int legs : {3, 4, 5}) {
    said.plan_length = legs;
    EXPECT_TRUE(DifferencesOf(navigation, said).empty());
  }
  said.plan_length = 6;
  EXPECT_FALSE(DifferencesOf(navigation, said).empty());
}

TEST(Agreement, ASceneOfOnesOwnHasItsOwnObjects) {
  const TaskFile& stacking = *Folder().Find("stacking");
  const TaskFile other = ReadTaskFile(stacking.path, {"cup", "tin", "box"});
  EXPECT_EQ(other.spec.actions.size(), 27u);
  EXPECT_EQ(other.goals.size(), 6u);
  EXPECT_TRUE(DifferencesOf(ForScene(stacking, other.spec), other.spec).empty());
  EXPECT_FALSE(DifferencesOf(stacking, other.spec).empty());
}

TEST(Agreement, CausesThatTheFileDoesNotKnow) {
  const TaskFile file = ParseTaskFile(LearnedFile(Rover()), "rover.yaml");
  sim::TaskSpec said = Rover();
  said.causes.push_back({"wet", "it is wet"});
  EXPECT_EQ(UnknownCauses(file, said), std::vector<std::string>{"wet"});
}

}  // namespace
}  // namespace prospect::tasks
