#include "tools/evaluate/shift_sweep.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "model/weights_file.h"
#include "tools/evaluate/episode.h"
#include "tools/evaluate/record_file.h"
#include "tools/evaluate/search_deciders.h"

namespace prospect::tools {
namespace {

using nlohmann::json;

constexpr std::uint64_t kScene = 1'430'000;  // tuning scenes: never in a reported figure

SweepOptions Options() {
  SweepOptions options;
  options.task = "navigation";
  options.weights = std::string(PROSPECT_ROOT) + "/model/weights/navigation.safetensors";
  options.novelty_level = 0;  // whatever the weights know of pictures
  options.search.samples = 6;
  options.points = {{}, {"camera", 3}, {"noise", 5}};
  return options;
}

// What the sweep says of a point is what an episode with shifted pictures comes to, though the plan
// was carried out where nothing is shifted.
TEST(ShiftSweep, IsAnOpenLoopWithShiftedPictures) {
  const SweepOptions options = Options();
  ShiftSweep sweep(options);
  const auto engine = model::LoadSearchEngine(options.weights, 1);
  int attempted = 0;
  for (std::uint64_t seed = kScene; seed < kScene + 3; ++seed) {
    const json record = sweep.Run(seed);
    EXPECT_EQ(record["seed"], seed);
    for (const ShiftPoint& point : options.points) {
      sim::TaskOptions world;
      if (point.strength > 0) sim::SetShift(point.factor, point.strength, &world);
      const auto task = sim::MakeTask("navigation", world);
      const auto open = MakeOpenLoop(MakeLearned(PlanBy::kSearch, engine.get(), options.search));
      const EpisodeRecord episode = RunEpisode(*task, *open, seed, world.image_noise);
      const json& found = record["points"][point.Name()];
      EXPECT_EQ(found["ending"], ToString(episode.ending)) << seed << ' ' << point.Name();
      EXPECT_EQ(found["score"], episode.first_score);
      EXPECT_EQ(found["reason"], episode.reason);
      attempted += episode.ending != Ending::kRefused;
    }
  }
  EXPECT_GT(attempted, 3);
}

TEST(ShiftPoints, BeginWithoutAShift) {
  const auto points = ShiftPoints({"light", "noise"});
  ASSERT_EQ(points.size(), 1u + 2 * sim::kShiftStrengths);
  EXPECT_EQ(points[0].Name(), "none");
  EXPECT_EQ(points[1].Name(), "light 1");
  EXPECT_EQ(points.back().Name(), "noise 5");
  EXPECT_THROW(ShiftPoints({"wind"}), std::invalid_argument);
}

// `solved`, `failed`, `stopped` and `refused` scenes, and two more refused for their pictures.
std::vector<json> Scenes(int solved, int failed, int stopped, int refused) {
  std::vector<json> scenes;
  const auto add = [&](const char* ending, bool unlike) {
    const json point = {{"ending", ending}, {"unlike", unlike}};
    scenes.push_back({{"seed", scenes.size()}, {"points", {{"none", point}, {"light 2", point}}}});
  };
  for (int i = 0; i < solved; ++i) add("solved", false);
  for (int i = 0; i < failed; ++i) add("failed", false);
  for (int i = 0; i < stopped; ++i) add("stopped", false);
  for (int i = 0; i < refused; ++i) add("refused", false);
  add("refused", true);
  add("refused", true);
  return scenes;
}

TEST(SummariseShifts, JudgesWhereThirtyAreAttempted) {
  const std::vector<ShiftPoint> points = {{}, {"light", 2}};
  const json good = SummariseShifts(Scenes(24, 5, 1, 10), points);
  EXPECT_EQ(good["scenes"], 42);
  const json& light = good["points"][1];
  EXPECT_EQ(light["amount"], sim::ShiftAmount("light", 2));
  EXPECT_EQ(light["solved"], 24);
  EXPECT_EQ(light["failed"], 6) << "stopped is attempted and not solved";
  EXPECT_EQ(light["refused"], 12);
  EXPECT_EQ(light["unlike"], 2);
  EXPECT_DOUBLE_EQ(light["failed_share"], 0.2);
  EXPECT_EQ(light["met"], true);
  EXPECT_EQ(SummariseShifts(Scenes(23, 7, 0, 0), points)["points"][0]["met"], false);
  EXPECT_TRUE(SummariseShifts(Scenes(9, 20, 0, 0), points)["points"][0]["met"].is_null());
  const std::string table = ShiftTable(SummariseShifts(Scenes(23, 7, 0, 0), points));
  EXPECT_NE(table.find("above 20 %"), std::string::npos) << table;
  EXPECT_NE(table.find("light x"), std::string::npos) << table;
  EXPECT_NE(ShiftTable(SummariseShifts(Scenes(0, 0, 0, 5), points)).find("nothing was attempted"),
            std::string::npos);
}

class RecordFileTest : public testing::Test {
 protected:
  RecordFileTest()
      : folder_(testing::TempDir() + "record_file_" + std::to_string(getpid())),
        path_(folder_ + "/deep/records.jsonl") {}
  ~RecordFileTest() override { std::filesystem::remove_all(folder_); }

  std::string folder_, path_;
};

TEST_F(RecordFileTest, GoesOnWhereItWas) {
  const json key = {{"task", "navigation"}, {"samples", 3}};
  {
    RecordFile file(path_, key);
    EXPECT_TRUE(file.records().empty());
    file.Store({{"seed", 7}, {"x", 1.5}});
    file.Store({{"seed", 9}, {"x", 2}});
  }
  std::ofstream(path_, std::ios::app) << "{\"seed\": 11, \"x\"";  // a writer that was killed
  RecordFile again(path_, key);
  ASSERT_EQ(again.records().size(), 2u);
  EXPECT_EQ(again.records().at(7)["x"], 1.5);
  again.Store({{"seed", 11}, {"x", 3}});
  EXPECT_EQ(RecordFile(path_, key).records().size(), 3u) << "the cut line spoils no other";
  EXPECT_THROW(RecordFile(path_, {{"task", "stacking"}}), std::invalid_argument);
}

}  // namespace
}  // namespace prospect::tools
