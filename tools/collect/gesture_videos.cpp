#include "tools/collect/gesture_videos.h"

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "base/atomic_file.h"
#include "base/lock.h"
#include "base/seconds_since.h"
#include "base/sensor_noise.h"
#include "report/video_reader.h"
#include "report/video_writer.h"
#include "sim/suturing/suturing_task.h"
#include "tools/collect/collector.h"
#include "tools/collect/gesture_trial.h"
#include "tools/common/fork_map.h"
#include "tools/common/progress.h"

namespace prospect::tools {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

constexpr char kFolder[] = "Suturing";
constexpr int kMostTrials = 39;
constexpr int kMostAttempts = 50;
constexpr std::uint64_t kLastSeed = 999'999;
constexpr std::uint64_t kRightEyeNoise = 0x7269676874ULL;

constexpr char kReadme[] =
    "SIMULATED suturing trials, made by Prospect (./prospect collect --task suturing --format\n"
    "jigsaws). Nothing here was recorded from a surgeon or a robot, and nothing is taken from the\n"
    "JIGSAWS data set: only the names and the layout of its files are the same. Skill levels and\n"
    "scores in the meta file are 0. See Suturing/simulated.json for how it was made.\n";

// Where a trial's files are.
class Places {
 public:
  explicit Places(const std::string& out) : root_(fs::path(out) / kFolder) {}

  fs::path root() const { return root_; }
  fs::path manifest() const { return root_ / "simulated.json"; }
  fs::path meta() const { return root_ / "meta_file_Suturing.txt"; }
  fs::path readme() const { return root_.parent_path() / "README.txt"; }
  fs::path video(const std::string& trial, int eye) const {
    return root_ / "video" / ("Suturing_" + trial + "_capture" + std::to_string(eye) + ".avi");
  }
  fs::path transcription(const std::string& trial) const {
    return root_ / "transcriptions" / ("Suturing_" + trial + ".txt");
  }

 private:
  fs::path root_;
};

int TrialsOf(const cli::CollectOptions& options) { return options.trials.value_or(kMostTrials); }

void CheckOptions(const cli::CollectOptions& options) {
  if (TrialsOf(options) < 1 || TrialsOf(options) > kMostTrials) {
    throw CollectUsageError("--trials is " + std::to_string(TrialsOf(options)) +
                            ": JIGSAWS has 39 suturing trials, give 1 to 39");
  }
  if (options.seed + TrialsOf(options) - 1 > kLastSeed || options.seed > kLastSeed) {
    throw CollectUsageError(
        "seeds of trials must lie in 0 to 999,999, later ones are kept for "
        "evaluation: give a smaller --seed");
  }
  if (options.width < 32 || options.width > 1920 || options.height < 24 || options.height > 1080) {
    throw CollectUsageError("pictures are 32 to 1920 pixels wide and 24 to 1080 high");
  }
}

// The surgeon of a trial: its user, B to I.
int SurgeonOf(int i) { return GestureTrialName(i)[0] - 'B'; }

sim::TaskOptions TaskOptionsOf(const cli::CollectOptions& options, int i) {
  sim::TaskOptions task;
  task.surgeon = SurgeonOf(i);
  task.frames_per_second = options.frames_per_second;
  task.image_noise = options.image_noise;
  return task;
}

// What all trials of a folder have in common.
json Manifest(const cli::CollectOptions& options) {
  std::string world;
  try {
    world = sim::SuturingTask(TaskOptionsOf(options, 0)).spec().world_version;
  } catch (const std::invalid_argument& error) {
    throw CollectUsageError(error.what());
  }
  return {{"simulated", true},
          {"world_version", world},
          {"seed", options.seed},
          {"frames_per_second", options.frames_per_second},
          {"width", options.width},
          {"height", options.height},
          {"right_eye", options.right_eye},
          {"failures", options.failures},
          {"image_noise", options.image_noise}};
}

void Prepare(const cli::CollectOptions& options, const Places& places) {
  const json manifest = Manifest(options);
  if (fs::exists(places.manifest())) {
    std::ifstream file(places.manifest());
    if (json::parse(file, nullptr, false) != manifest) {
      throw CollectUsageError(places.root().string() +
                              " was begun with other options or another world: remove it");
    }
    if (!options.resume) {
      throw CollectUsageError(places.root().string() +
                              " holds trials of an earlier run: give --resume to go on with them, "
                              "or remove the folder");
    }
  } else if (fs::exists(places.root()) && !fs::is_empty(places.root())) {
    throw CollectUsageError(places.root().string() +
                            " is there already and was not made by this program: give another "
                            "--out");
  }
  std::error_code error;
  for (const fs::path& folder : {places.root() / "video", places.root() / "transcriptions"}) {
    fs::create_directories(folder, error);
    if (error) throw std::runtime_error("cannot write to " + folder.string());
  }
  base::WriteFile(places.manifest(), manifest.dump(2) + "\n");
  base::WriteFile(places.readme(), kReadme);
}

// One trial's task, videos and their names.
class TrialMaker {
 public:
  TrialMaker(const cli::CollectOptions& options, int i)
      : options_(options),
        places_(options.out),
        name_(GestureTrialName(i)),
        seed_(options.seed + static_cast<std::uint64_t>(i)),
        task_(TaskOptionsOf(options, i)) {}

  json Make() {
    for (int attempt = 0; attempt < kMostAttempts; ++attempt) {
      const GestureTrial trial = FilmTrial(attempt);
      if (!trial.reason.empty()) failures_.push_back(trial.reason);
      if (!trial.reason.empty() && !options_.failures) continue;
      GiveNames(trial);
      return {{"kept", false}, {"frames", trial.frames}, {"failures", failures_}};
    }
    throw std::runtime_error("trial " + name_ + " failed " + std::to_string(kMostAttempts) +
                             " times");
  }

 private:
  GestureTrial FilmTrial(int attempt) {
    videos_.clear();
    for (int eye = 1; eye <= (options_.right_eye ? 2 : 1); ++eye) {
      videos_.push_back(std::make_unique<report::VideoWriter>(
          places_.video(name_, eye).string(), options_.frames_per_second, options_.width,
          options_.height, report::VideoFormat::kMotionJpeg));
    }
    return PlayGestureTrial(&task_, seed_, attempt, [this](int frame) { Film(frame); });
  }

  // The transcription last: a trial that has one is whole.
  void GiveNames(const GestureTrial& trial) {
    for (const auto& video : videos_) video->Finish();
    base::WriteFile(places_.transcription(name_), TranscriptionText(trial));
  }

  void Film(int frame) {
    for (std::size_t i = 0; i < videos_.size(); ++i) {
      sim::Image image = i == 0 ? task_.Render(options_.width, options_.height)
                                : task_.RenderRightEye(options_.width, options_.height);
      const std::uint64_t noise = i == 0 ? seed_ : seed_ ^ kRightEyeNoise;
      base::AddSensorNoise(image.rgb.data(), image.rgb.size(), noise, frame - 1,
                           options_.image_noise);
      videos_[i]->Add(image);
    }
  }

  const cli::CollectOptions& options_;
  Places places_;
  std::string name_;
  std::uint64_t seed_;
  sim::SuturingTask task_;
  std::vector<std::string> failures_;
  std::vector<std::unique_ptr<report::VideoWriter>> videos_;
};

// The frames of a trial that an earlier run finished; 0 if none did.
int KeptFrames(const Places& places, const std::string& name) {
  const fs::path video = places.video(name, 1);
  const bool whole = fs::exists(places.transcription(name)) && fs::exists(video);
  return whole ? report::FramesOfVideo(video.string()) : 0;
}

json MakeOrKeep(const cli::CollectOptions& options, int i) {
  const int kept = KeptFrames(Places(options.out), GestureTrialName(i));
  if (kept > 0) return {{"kept", true}, {"frames", kept}, {"failures", json::array()}};
  return TrialMaker(options, i).Make();
}

void Add(const json& line, const cli::CollectOptions& options, GestureVideoSummary* summary) {
  ++summary->trials;
  summary->kept += line.at("kept").get<bool>();
  const int frames = line.at("frames");
  summary->frames += frames;
  summary->simulated_seconds += static_cast<double>(frames) / options.frames_per_second;
  for (const std::string reason : line.at("failures")) ++summary->failures[reason];
}

std::string MetaText(int trials) {
  std::string text;
  for (int i = 0; i < trials; ++i) {
    text += "Suturing_" + GestureTrialName(i) + "\tSIMULATED\t0\t0\t0\t0\t0\t0\t0\n";
  }
  return text;
}

}  // namespace

std::string GestureTrialName(int i) {
  int left = i;
  for (char user = 'B'; user <= 'I'; ++user) {
    for (int trial = 1; trial <= 5; ++trial) {
      if (user == 'H' && trial == 2) continue;
      if (left-- == 0) return user + ("00" + std::to_string(trial));
    }
  }
  throw std::out_of_range("there are 39 suturing trials");
}

GestureVideoSummary CollectGestureVideos(const cli::CollectOptions& options) {
  CheckOptions(options);
  Manifest(options);  // refuses bad options before anything is written
  const Places places(options.out);
  const base::Lock own = base::LockFolder(places.root().string());
  Prepare(options, places);
  GestureVideoSummary summary;
  Progress progress("trials", TrialsOf(options));
  const auto start = std::chrono::steady_clock::now();
  const auto make_worker = [&options] {
    report::UseOneThread();  // the processes share the work already
    return [&options](int i) { return MakeOrKeep(options, i).dump(); };
  };
  const Extent extent =
      ForkMap(TrialsOf(options), options.jobs, make_worker, [&](int, const std::string& line) {
        Add(json::parse(line), options, &summary);
        progress.Step();
      });
  if (extent.stopped()) throw Interrupted(extent.Words("trials") + "; --resume goes on with them");
  base::WriteFile(places.meta(), MetaText(TrialsOf(options)));
  summary.wall_seconds = base::SecondsSince(start);
  return summary;
}

}  // namespace prospect::tools
