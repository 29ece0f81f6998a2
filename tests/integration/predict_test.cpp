// A video on the bus, what the model server says comes next, and what a search says to weights that
// only predict pictures.

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "report/video_writer.h"
#include "tests/integration/support/deployment.h"
#include "tests/unit/report/png_size.h"

namespace prospect::tests {
namespace {

namespace fs = std::filesystem;

const std::string kWeights = std::string(PROSPECT_ROOT) + "/model/weights/suturing.safetensors";

constexpr int kWidth = 320, kHeight = 240;

// A light square with its middle at column `at`.
sim::Image TissueWithAPad(int at) {
  sim::Image picture{kWidth, kHeight, {}};
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const bool pad = std::abs(x - at) < 20 && std::abs(y - 120) < 20;
      for (const int value : {pad ? 200 : 170, pad ? 200 : 110, pad ? 200 : 90})
        picture.rgb.push_back(static_cast<std::uint8_t>(value));
    }
  }
  return picture;
}

class Predicting : public ::testing::Test {
 protected:
  Predicting()
      : deployment_(::testing::UnitTest::GetInstance()->current_test_info()->name()),
        video_(deployment_.folder + "/film.avi"),
        transcription_(deployment_.folder + "/film.txt") {
    report::VideoWriter film(video_, 30, kWidth, kHeight, report::VideoFormat::kMotionJpeg);
    for (int i = 0; i < 120; ++i) film.Add(TissueWithAPad(60 + 2 * i));
    film.Finish();
    std::ofstream(transcription_) << "7 36 G2\n40 75 G3\n76 100 G6\n";
  }

  Process Player(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments = {"play", "--video", video_, "--transcription",
                                          transcription_};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return Process("prospect-video", arguments, deployment_.folder + "/player.log");
  }
  Process Model() const {
    return Process("prospect-model-server", {"--weights", kWeights},
                   deployment_.folder + "/model.log");
  }
  /// Exit code, with what it printed in `said_`.
  int Predict(const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"predict", "--out", Out("")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const std::string log = deployment_.folder + "/predict.log";
    Process predict("prospect-video", arguments, log);
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
  EXPECT_EQ(report::PngSize(Out("seen.png")).width, 128u);
  EXPECT_EQ(report::PngSize(Out("seen.png")).height, 96u);
  EXPECT_EQ(report::PngSize(Out("future-16.png")).width, 128u) << "G3, and each of 15 after it";
  EXPECT_FALSE(fs::exists(Out("future-17.png")));
  EXPECT_GT(report::PngSize(Out("futures.png")).width, 1000u);
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
