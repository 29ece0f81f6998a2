#include "tools/jigsaws/converter.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>

#include "model/dataset.h"
#include "model/jigsaws/gestures.h"
#include "model/jigsaws/transcription.h"
#include "model/trial_set_writer.h"
#include "report/video_reader.h"
#include "tools/common/progress.h"

namespace prospect::tools {
namespace {

namespace fs = std::filesystem;
using model::DataError;
using model::jigsaws::KeptFrames;
using model::jigsaws::Transcription;
using model::jigsaws::TrialName;

constexpr const char* kLeftCamera = "_capture1.avi";

// Names that the folder's transcriptions and left videos speak of, whole or not.
std::set<std::string> TrialTexts(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder / "transcriptions")) {
    if (entry.path().extension() == ".txt") names.insert(entry.path().stem().string());
  }
  for (const auto& entry : fs::directory_iterator(folder / "video")) {
    const std::string name = entry.path().filename().string();
    const std::size_t at = name.rfind(kLeftCamera);
    if (at != std::string::npos && at + std::string(kLeftCamera).size() == name.size()) {
      names.insert(name.substr(0, at));
    }
  }
  return names;
}

void RequireFolders(const fs::path& folder) {
  for (const char* part : {"transcriptions", "video"}) {
    if (fs::is_directory(folder / part)) continue;
    throw DataError((folder / part).string() +
                    ": is missing; --root names the folder that holds the task's, as distributed");
  }
}

class Converter {
 public:
  Converter(const JigsawsOptions& options, const std::function<void(const std::string&)>& say,
            const std::atomic<bool>* stop)
      : options_(options),
        folder_(fs::path(options.root) / options.folder),
        world_version_(fs::exists(folder_ / "simulated.json") ? "jigsaws-simulated" : "jigsaws"),
        say_(say),
        stop_(stop) {}

  JigsawsReport Run() {
    RequireFolders(folder_);
    const std::set<std::string> names = TrialTexts(folder_);
    if (names.empty()) throw DataError(folder_.string() + ": holds no trials");
    RequireHeldOut(names);
    model::TrialSetWriter writer(options_.out);
    Progress progress("trials", static_cast<int>(names.size()));
    for (const std::string& name : names) {
      TakeOrSay(name, &writer);
      progress.Step();
    }
    if (done_.empty()) throw DataError(folder_.string() + ": none of its trials can be used");
    writer.Commit(model::jigsaws::AssignParts(done_, options_.hold_out));
    report_.trials = done_.size();
    return report_;
  }

 private:
  // A wrong name is said now rather than after minutes.
  void RequireHeldOut(const std::set<std::string>& texts) const {
    std::vector<TrialName> names;
    for (const std::string& text : texts) {
      try {
        names.push_back(model::jigsaws::ParseTrialName(options_.folder, text));
      } catch (const DataError&) {
        continue;  // said when its turn comes
      }
    }
    if (!names.empty()) model::jigsaws::AssignParts(names, options_.hold_out);
  }

  void TakeOrSay(const std::string& text, model::TrialSetWriter* writer) {
    try {
      Take(text, writer);
    } catch (const DataError& error) {
      writer->Drop();
      ++report_.left_out;
      say_(text + ": left out: " + error.what());
    }
  }

  void Take(const std::string& text, model::TrialSetWriter* writer) {
    const TrialName name = model::jigsaws::ParseTrialName(options_.folder, text);
    const std::string path = (folder_ / "transcriptions" / (text + ".txt")).string();
    if (!fs::is_regular_file(path)) throw DataError(path + ": is missing");
    Transcription transcription = model::jigsaws::ReadTranscription(path);
    report::VideoReader video((folder_ / "video" / (text + kLeftCamera)).string());
    model::Trial trial;
    trial.seed = name.seed();
    trial.width = model::jigsaws::kWidth;
    trial.height = model::jigsaws::kHeight;
    writer->Begin(trial, KeptFrames(transcription, options_.every).Count());
    std::vector<int> kept = CopyFrames(&video, path, &transcription, writer);
    trial = model::jigsaws::LabelsOf(transcription, kept, options_.every,
                                     1.0 / video.frames_per_second());
    trial.seed = name.seed();
    trial.name = text;
    trial.task = model::jigsaws::TaskOfFolder(options_.folder);
    trial.world_version = world_version_;
    writer->End(trial);
    done_.push_back(name);
    report_.frames += trial.frames();
    Tell(text, transcription.repairs);
  }

  // Returns the numbers of the frames that were copied. A video that ends early cuts the
  // transcription.
  std::vector<int> CopyFrames(report::VideoReader* video, const std::string& path,
                              Transcription* transcription, model::TrialSetWriter* writer) const {
    const KeptFrames keeps(*transcription, options_.every);
    std::vector<int> kept;
    std::vector<std::uint8_t> rgb;
    for (int frame = 1; frame <= keeps.last(); ++frame) {
      if (stop_->load()) throw Interrupted("interrupted; nothing was written");
      const bool good =
          video->Next() && (!keeps.Keeps(frame) ||
                            video->Picture(model::jigsaws::kWidth, model::jigsaws::kHeight, &rgb));
      if (!good) {
        model::jigsaws::CutAtFrame(frame - 1, path, transcription);
        break;
      }
      if (!keeps.Keeps(frame)) continue;
      writer->AddFrame(rgb.data());
      kept.push_back(frame);
    }
    return kept;
  }

  void Tell(const std::string& text, const std::vector<std::string>& repairs) {
    if (!repairs.empty()) ++report_.repaired;
    for (const std::string& repair : repairs) say_(text + ": repaired: " + repair);
  }

  const JigsawsOptions& options_;
  fs::path folder_;
  std::string world_version_;  // also in weights that are trained on it
  const std::function<void(const std::string&)>& say_;
  const std::atomic<bool>* stop_;
  std::vector<TrialName> done_;
  JigsawsReport report_;
};

}  // namespace

JigsawsReport ConvertJigsaws(const JigsawsOptions& options,
                             const std::function<void(const std::string&)>& say,
                             const std::atomic<bool>* stop) {
  return Converter(options, say, stop).Run();
}

}  // namespace prospect::tools
