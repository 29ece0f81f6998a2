#include "tools/recordings/from_video.h"

#include <algorithm>
#include <cmath>

#include "model/segments/trial_labels.h"
#include "report/video_reader.h"
#include "tools/common/progress.h"
#include "tools/recordings/video_folder.h"

namespace prospect::tools {
namespace {

using model::segments::NamedTrials;

class VideoPictures : public Pictures {
 public:
  explicit VideoPictures(const std::string& path) : video_(path) {}

  double frames_per_second() const { return video_.frames_per_second(); }
  bool Next() override { return video_.Next(); }
  bool Get(int width, int height, std::vector<std::uint8_t>* rgb) override {
    return video_.Picture(width, height, rgb);
  }

 private:
  report::VideoReader video_;
};

// A wrong name to hold out is said now rather than after minutes.
void RequireHeldOut(const VideoFolder& folder, const std::vector<std::string>& held_out) {
  NamedTrials names;
  for (const VideoTrial& trial : folder.trials())
    names.emplace(trial.name, model::segments::NumberOfName(trial.name));
  model::segments::AssignParts(names, held_out);
}

int EveryOf(const FromVideoOptions& options, const tasks::TaskFile& task, double per_second) {
  if (options.every > 0) return options.every;
  return std::max(1, static_cast<int>(std::lround(task.spec.tick_seconds * per_second)));
}

}  // namespace

ConversionReport FromVideo(const tasks::TaskFile& task, const FromVideoOptions& options,
                           const Conversion::Say& say, const std::atomic<bool>* stop) {
  const VideoFolder folder(options.folder);
  RequireHeldOut(folder, options.held_out);
  Conversion conversion(task, options.out, say, stop);
  Progress progress("trials", static_cast<int>(folder.trials().size()));
  for (const VideoTrial& trial : folder.trials()) {
    conversion.Try(trial.name, [&] {
      Recording recording;
      recording.name = trial.name;
      recording.number = model::segments::NumberOfName(trial.name);
      recording.world_version = folder.world_version();
      recording.path = trial.table;
      recording.before = !folder.transcribed();
      VideoPictures pictures(trial.video);
      const double per_second = pictures.frames_per_second();
      recording.segmentation = folder.Read(trial, conversion.action_names(), per_second);
      recording.every = EveryOf(options, task, per_second);
      recording.tick_seconds = recording.every / per_second;
      conversion.Take(std::move(recording), &pictures);
    });
    progress.Step();
  }
  return conversion.Finish(options.folder, options.held_out);
}

}  // namespace prospect::tools
