#include "tools/recordings/video_folder.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>

#include "model/dataset.h"
#include "model/segments/segment_csv.h"
#include "model/segments/transcription.h"

namespace prospect::tools {
namespace {

namespace fs = std::filesystem;
using model::DataError;

constexpr const char* kLeftCamera = "_capture1.avi";
constexpr std::array kVideoEndings = {".mp4", ".avi", ".mkv", ".mov", ".webm"};

bool IsVideo(const fs::path& file) {
  return std::find(kVideoEndings.begin(), kVideoEndings.end(), file.extension().string()) !=
         kVideoEndings.end();
}

using Trials = std::map<std::string, VideoTrial>;

void AddVideo(const std::string& name, const fs::path& file, Trials* trials) {
  VideoTrial& trial = (*trials)[name];
  if (!trial.video.empty())
    throw DataError(file.string() + ": there is " + trial.video + ", too: which one is meant?");
  trial.video = file.string();
}

// Names that tables or videos speak of, whole or not.
Trials Beside(const fs::path& folder) {
  Trials trials;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().stem().string();
    if (IsVideo(entry.path())) AddVideo(name, entry.path(), &trials);
    if (entry.path().extension() == ".csv") trials[name].table = entry.path().string();
  }
  for (auto& [name, trial] : trials) {
    if (trial.video.empty()) trial.video = (folder / (name + ".mp4")).string();
    if (trial.table.empty()) trial.table = (folder / (name + ".csv")).string();
  }
  return trials;
}

Trials Transcribed(const fs::path& folder) {
  Trials trials;
  for (const auto& entry : fs::directory_iterator(folder / "transcriptions")) {
    if (entry.path().extension() == ".txt") trials[entry.path().stem().string()];
  }
  for (const auto& entry : fs::directory_iterator(folder / "video")) {
    const std::string name = entry.path().filename().string();
    const std::size_t at = name.rfind(kLeftCamera);
    if (at != std::string::npos && at + std::string(kLeftCamera).size() == name.size())
      trials[name.substr(0, at)];
  }
  for (auto& [name, trial] : trials) {
    trial.video = (folder / "video" / (name + kLeftCamera)).string();
    trial.table = (folder / "transcriptions" / (name + ".txt")).string();
  }
  return trials;
}

}  // namespace

VideoFolder::VideoFolder(const std::string& path) {
  const fs::path folder(path);
  if (!fs::is_directory(folder))
    throw DataError(path + ": is no folder; give the one that holds videos and tables");
  transcribed_ = fs::is_directory(folder / "transcriptions") && fs::is_directory(folder / "video");
  world_version_ = !transcribed_                           ? "video"
                   : fs::exists(folder / "simulated.json") ? "jigsaws-simulated"
                                                           : "jigsaws";
  for (auto& [name, trial] : transcribed_ ? Transcribed(folder) : Beside(folder)) {
    trials_.push_back(trial);
    trials_.back().name = name;
  }
  if (trials_.empty())
    throw DataError(path +
                    ": holds no trials: neither NAME.mp4 and NAME.csv nor the folders video and "
                    "transcriptions");
}

model::segments::Segmentation VideoFolder::Read(const VideoTrial& trial,
                                                const std::vector<std::string>& names,
                                                double frames_per_second) const {
  if (!fs::is_regular_file(trial.table)) throw DataError(trial.table + ": is missing");
  if (transcribed_) return model::segments::ReadTranscription(trial.table, names);
  return model::segments::FromSeconds(model::segments::ReadSegmentCsv(trial.table, names),
                                      frames_per_second, trial.table);
}

}  // namespace prospect::tools
