// One episode of a robot, recorded twice: on the bus, and by a camera with a table of what was done
// when. Both become the same trial.
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>

#include "examples/robots/cpp/world.h"
#include "model/dataset.h"
#include "report/video_writer.h"
#include "services/from_log/log_importer.h"
#include "services/simulator/scene.h"
#include "tests/unit/model/test_folder.h"
#include "tests/unit/services/log_writer.h"
#include "tests/unit/tools/recorded_trials.h"
#include "tools/recordings/from_video.h"

namespace prospect::services {
namespace {

constexpr double kTick = 0.5;
constexpr int kEnlarged = 2;  // the film's pixels for each of the robot's

/// The sorting table, told to a log, a film and a table at once.
class Recorder {
 public:
  Recorder(std::uint64_t seed, const task_t& task, LogWriter* log, const std::string& film)
      : world_(seed),
        task_(task),
        log_(*log),
        film_(film + ".mp4", 1 / kTick, kEnlarged * sorting::kPixels, kEnlarged * sorting::kPixels),
        table_(film + ".csv") {
    status_.episode_id = static_cast<std::int64_t>(seed);
    Look();
  }

  /// Until an action fails or the plan is over.
  void CarryOut(const std::vector<int>& plan) {
    for (const int action : plan) {
      if (!CarryOut(action)) break;
    }
    film_.Finish();
  }

 private:
  bool CarryOut(int action) {
    const std::int64_t begun = status_.frame;
    world_.Begin(action);
    ++status_.command_id;
    status_.action = action;
    status_.state = action_status_t::STATE_RUNNING;
    log_.Write(status_);
    for (bool goes_on = true; goes_on;) {
      goes_on = world_.Tick();
      ++status_.frame;
      Look();
      if (goes_on) log_.Write(status_);
    }
    status_.reason = world_.cause();
    const bool failed = !status_.reason.empty();
    status_.state = failed ? action_status_t::STATE_FAILED : action_status_t::STATE_SUCCEEDED;
    log_.Write(status_);
    table_ << kTick * static_cast<double>(begun) << ','
           << kTick * static_cast<double>(status_.frame) << ','
           << task_.actions[static_cast<std::size_t>(action)].name << ',' << !failed << ','
           << status_.reason << '\n';
    return !failed;
  }

  void Look() {
    observation_t o{};
    o.episode_id = status_.episode_id;
    o.frame = status_.frame;
    o.encoding = observation_t::ENCODING_RGB8;
    o.width = o.height = sorting::kPixels;
    o.data = world_.Picture();
    log_.Write(o);
    film_.Add(Enlarged(o.data));
  }

  static sim::Image Enlarged(const std::vector<std::uint8_t>& pixels) {
    sim::Image image{kEnlarged * sorting::kPixels, kEnlarged * sorting::kPixels, {}};
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) {
        const auto pixel = pixels.begin() + 3 * (y / kEnlarged * sorting::kPixels + x / kEnlarged);
        image.rgb.insert(image.rgb.end(), pixel, pixel + 3);
      }
    }
    return image;
  }

  sorting::World world_;
  const task_t& task_;
  LogWriter& log_;
  report::VideoWriter film_;
  std::ofstream table_;
  action_status_t status_{};
};

TEST(FromLogAndFromVideo, GiveOneEpisodeTheSameLabels) {
  const model::TestFolder folder;
  const std::string videos = folder / "videos", path = folder / "site.lcmlog";
  std::filesystem::create_directories(videos);
  const tasks::TaskFile file = tasks::ReadTaskFile(PROSPECT_ROOT "/examples/robots/sorting.yaml");
  const task_t task = MakeTaskMessage(file.spec);
  const std::vector<int> plans[] = {{0, 8, 5, 11}, {4, 10, 1, 8}, {2, 9, 7, 11}, {6, 11, 3, 8}};
  constexpr int kEpisodes = 24;
  {
    LogWriter log(path);
    log.Write(task);
    for (std::uint64_t seed = 0; seed < kEpisodes; ++seed)
      Recorder(seed, task, &log, videos + "/" + std::to_string(seed)).CarryOut(plans[seed % 4]);
  }
  std::map<std::string, model::Trial> logged;
  LogImporter importer([&](const model::Trial& t) { logged[std::to_string(t.seed)] = t; });
  EventLog log(path);
  for (LogEvent event; log.Next(event);) importer.Take(event);
  importer.EndOfLog();
  ASSERT_EQ(logged.size(), kEpisodes);

  tools::FromVideoOptions options;
  options.folder = videos;
  options.out = folder / "videos.h5";
  const std::atomic<bool> stop{false};
  std::string said;
  tools::FromVideo(
      file, options, [&said](const std::string& line) { said += line; }, &stop);
  EXPECT_EQ(said, "");
  const model::TrialFile filmed(options.out);
  ASSERT_EQ(filmed.size(), kEpisodes);
  int succeeded = 0, segments = 0;
  for (std::size_t i = 0; i < filmed.size(); ++i) {
    const model::Trial trial = filmed.Read(i);
    SCOPED_TRACE(trial.name);
    tools::ExpectSameLabels(trial, logged.at(trial.name));
    EXPECT_EQ(trial.frames(), logged.at(trial.name).frames());
    succeeded += trial.succeeded();
    segments += trial.segments();
  }
  EXPECT_GT(succeeded, 0);
  EXPECT_GT(segments, kEpisodes + 5) << "some got beyond their first action";
}

}  // namespace
}  // namespace prospect::services
