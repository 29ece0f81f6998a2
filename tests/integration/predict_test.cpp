// A video on the bus, what the model server says comes next, and what a search says to weights that
// only predict pictures.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>
#include <string>

#include "tests/integration/support/deployment.h"

namespace prospect::tests {
namespace {

namespace fs = std::filesystem;

const std::string kWeights = std::string(PROSPECT_ROOT) + "/model/weights/suturing.safetensors";

class Predicting : public ::testing::Test {
 protected:
  Predicting()
      : deployment_(::testing::UnitTest::GetInstance()->current_test_info()->name()),
        video_(deployment_.folder + "/film.avi"),
        transcription_(deployment_.folder + "/film.txt") {
    cv::VideoWriter film(video_, cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 30,
                         cv::Size(320, 240));
    for (int i = 0; i < 120; ++i) {
      cv::Mat picture(240, 320, CV_8UC3, cv::Scalar(90, 110, 170));
      cv::circle(picture, {60 + 2 * i, 120}, 20, cv::Scalar(200, 200, 200), cv::FILLED);
      film.write(picture);
    }
    std::ofstream(transcription_) << "7 36 G2\n40 75 G3\n76 100 G6\n";
  }

  Process Player(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments = {"--video", video_, "--transcription", transcription_};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return Process("prospect-player", arguments, deployment_.folder + "/player.log");
  }
  Process Model() const {
    return Process("prospect-model-server", {"--weights", kWeights},
                   deployment_.folder + "/model.log");
  }
  /// Exit code, with what it printed in `said_`.
  int Predict(const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"--out", Out("")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const std::string log = deployment_.folder + "/predict.log";
    Process predict("prospect-predict", arguments, log);
    const int code = predict.Wait(60000);
    said_ = ReadText(log);
    return code;
  }
  std::string Out(const std::string& name) const { return deployment_.folder + "/out/" + name; }

  Deployment deployment_;
  const std::string video_, transcription_;
  std::string said_;
};

TEST_F(Predicting, WritesWhatComesNextBesideWhatCame) {
  const Process model = Model();
  const Process player = Player({"--loop"});
  ASSERT_EQ(Predict({"--segment", "1", "--from-start", "--truth", "30"}), 0) << said_;
  EXPECT_NE(said_.find("future-01.png  G3 push the needle through the tissue  MAE 0."),
            std::string::npos)
      << said_;
  EXPECT_NE(said_.find("G3 push the needle through the tissue, then G6"), std::string::npos);
  const cv::Mat seen = cv::imread(Out("seen.png"));
  EXPECT_EQ(seen.cols, 128);
  EXPECT_EQ(seen.rows, 96);
  EXPECT_EQ(cv::imread(Out("future-16.png")).cols, 128) << "G3, and each of 15 after it";
  EXPECT_FALSE(fs::exists(Out("future-17.png")));
  EXPECT_GT(cv::imread(Out("futures.png")).cols, 1000);
}

TEST_F(Predicting, NamedGesturesAreFollowed) {
  const Process model = Model();
  const Process player = Player({"--loop"});
  ASSERT_EQ(Predict({"--actions", "G3,G6,G4"}), 0) << said_;
  EXPECT_TRUE(fs::exists(Out("future-03.png")));
  EXPECT_FALSE(fs::exists(Out("future-04.png")));
  EXPECT_EQ(Predict({"--actions", "G3,G77"}), 2);
  EXPECT_NE(said_.find("TASK has no 'G77'"), std::string::npos) << said_;
}

TEST_F(Predicting, WithoutAServerItSaysWhatIsMissing) {
  const Process player = Player({"--loop"});
  EXPECT_EQ(Predict({"--services-timeout-ms", "1500"}), 15);
  EXPECT_NE(said_.find("a model server"), std::string::npos) << said_;
}

TEST_F(Predicting, ASearchRefusesSuchWeightsByName) {
  const Process model = Model();
  const Process player = Player({"--loop"});
  const Process& executive = deployment_.Executive({"--no-reset", "--workers", "1"});
  EXPECT_EQ(const_cast<Process&>(executive).Wait(20000), 10);
  const std::string said = ReadText(deployment_.folder + "/1-prospect-executive.log");
  EXPECT_NE(said.find("predict pictures only"), std::string::npos) << said;
  EXPECT_NE(said.find("for task 'suturing'"), std::string::npos) << said;
}

TEST_F(Predicting, TheVideoIsPlayedWithItsGestures) {
  Witness witness;
  std::vector<observation_t> seen;
  std::vector<task_t> tasks;
  const auto subscription =
      witness.bus.Subscribe<observation_t>([&](const observation_t& o) { seen.push_back(o); });
  const auto second_subscription =
      witness.bus.Subscribe<task_t>([&](const task_t& task) { tasks.push_back(task); });
  const Process player = Player({"--speed", "4"});
  // Every third frame of 120, and the beginnings 40 and 76 are among them: 7, 40, 76 = 1 mod 3.
  ASSERT_TRUE(witness.Until([&] { return !seen.empty() && seen.back().frame == 39; }, 20000));
  ASSERT_FALSE(tasks.empty());
  EXPECT_EQ(tasks.back().num_actions, 15);
  EXPECT_EQ(tasks.back().actions[2].name, "G3");
  EXPECT_EQ(seen.back().width, 128);
  EXPECT_EQ(seen.back().height, 96);
  EXPECT_EQ(seen.back().sim_time_us, 3900000);
  for (const auto& [frame, label] : witness.labels) {
    const auto at = static_cast<int>(1 + 3 * frame);
    const int segment = at < 7 ? -1 : at < 40 ? 0 : at < 76 ? 1 : 2;
    const int actions[] = {15, 1, 2, 5};
    EXPECT_EQ(label.segment, segment) << "frame " << at;
    EXPECT_EQ(label.action, actions[segment + 1]) << "frame " << at;
    EXPECT_EQ(label.segment_end, at == 37 || at == 73 ? 1 : 0) << "frame " << at;
  }
  EXPECT_GE(witness.labels.size(), 38U);
}

TEST_F(Predicting, AVideoThatIsNoneIsNamed) {
  std::ofstream(video_) << "nothing";
  Process player = Player();
  EXPECT_EQ(player.Wait(20000), 14);
  EXPECT_NE(ReadText(deployment_.folder + "/player.log").find("film.avi: is no video"),
            std::string::npos);
}

}  // namespace
}  // namespace prospect::tests
