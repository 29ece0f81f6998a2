#include "tasks/task_folder.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace prospect::tasks {
namespace {

namespace fs = std::filesystem;

class TaskFolderTest : public testing::Test {
 protected:
  TaskFolderTest() { fs::create_directories(folder_); }
  ~TaskFolderTest() override { fs::remove_all(folder_); }

  void Write(const std::string& file, const std::string& name, const std::string& more = "") {
    std::ofstream(folder_ / file)
        << "name: " << name
        << "\npicture: {width: 32, height: 32}\nactions: [go]\nfirst: go\n"
           "follows: {}\nplan_length: 1\ntick_seconds: 0.1\n"
           "action_time_limit: 1\n"
        << more;
  }
  std::string Error() {
    try {
      TaskFolder(folder_).All();
    } catch (const TaskFileError& error) {
      return error.what();
    }
    return "";
  }

  const fs::path folder_ =
      fs::path(testing::TempDir()) / ("task_folder_test." + std::to_string(getpid()));
};

TEST_F(TaskFolderTest, TasksWithASimulatorComeFirst) {
  Write("b.yaml", "b", "default: true\n");
  Write("a.yaml", "a", "training: b\n");
  Write("s.yaml", "s", "simulator: {}\n");
  const TaskFolder folder(folder_);
  ASSERT_EQ(folder.All().size(), 3u);
  EXPECT_EQ(folder.All()[0].spec.name, "s");
  EXPECT_EQ(folder.All()[1].spec.name, "a");
  EXPECT_EQ(folder.Usual().spec.name, "b");
  EXPECT_EQ(folder.Find("c"), nullptr);
  EXPECT_EQ(folder.TrainingOf(*folder.Find("a")), "{}");
}

TEST_F(TaskFolderTest, SaysWhatIsWrong) {
  EXPECT_NE(Error().find("default: true"), std::string::npos);
  Write("a.yaml", "a", "default: true\n");
  Write("c.yaml", "b");
  const TaskFolder folder(folder_);
  EXPECT_EQ(folder.All().size(), 1u) << "a bad file keeps nobody from the others";
  EXPECT_NE(folder.Bad().at("c").find("name the file b.yaml"), std::string::npos);
  EXPECT_THROW(folder.Find("c"), TaskFileError);
  Write("c.yaml", "c", "default: true\n");
  EXPECT_NE(Error().find("leave it in one"), std::string::npos);
  EXPECT_THROW(TaskFolder("/nowhere").All(), TaskFileError);
}

TEST_F(TaskFolderTest, TrainingOfATaskThatIsNotThere) {
  Write("a.yaml", "a", "default: true\ntraining: stacknig\n");
  const TaskFolder folder(folder_);
  EXPECT_THROW(folder.TrainingOf(folder.Usual()), TaskFileError);
}

TEST(TaskFolder, NamesAndFiles) {
  EXPECT_FALSE(MeansFile("rover"));
  EXPECT_TRUE(MeansFile("rover.yaml"));
  EXPECT_TRUE(MeansFile("./rover"));
}

}  // namespace
}  // namespace prospect::tasks
