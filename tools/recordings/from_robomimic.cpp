#include "tools/recordings/from_robomimic.h"

#include <charconv>
#include <map>

#include "model/dataset.h"
#include "model/robomimic/demo_file.h"
#include "model/segments/segment_csv.h"
#include "model/segments/trial_labels.h"
#include "report/image_edit.h"
#include "tools/common/progress.h"

namespace prospect::tools {
namespace {

using model::robomimic::DemoFile;
using model::segments::CsvRow;
using DemoRows = std::map<std::string, std::vector<CsvRow>>;

class DemoPictures : public Pictures {
 public:
  DemoPictures(const DemoFile& file, const std::string& demo)
      : file_(file), demo_(demo), size_(file.SizeOf(demo)) {}

  bool Next() override { return ++at_ < size_.frames; }
  bool Get(int width, int height, std::vector<std::uint8_t>* rgb) override {
    file_.Read(demo_, at_, rgb);
    if (width == size_.width && height == size_.height) return true;
    *rgb = report::Scaled({size_.width, size_.height, *rgb}, width, height).rgb;
    return true;
  }

 private:
  const DemoFile& file_;
  const std::string& demo_;
  DemoFile::Size size_;
  int at_ = -1;
};

std::uint64_t NumberOf(const std::string& demo) {
  constexpr std::string_view kPrefix = "demo_";
  std::uint64_t number = 0;
  const char* end = demo.data() + demo.size();
  const bool named = demo.rfind(kPrefix, 0) == 0 && demo.size() > kPrefix.size();
  if (named) {
    const auto [rest, error] = std::from_chars(demo.data() + kPrefix.size(), end, number);
    if (error == std::errc() && rest == end && number <= model::kLastRecordedNumber) return number;
  }
  return model::segments::NumberOfName(demo);
}

std::string SizeText(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

void SaySize(const DemoFile& file, const sim::TaskSpec& spec, const Conversion::Say& say) {
  const DemoFile::Size size = file.SizeOf(file.demos().front());
  if (size.width == spec.image_width && size.height == spec.image_height) return;
  say("pictures of " + SizeText(size.width, size.height) + " are scaled to the task's " +
      SizeText(spec.image_width, spec.image_height));
}

// What the table speaks of must be there: a name mistyped would leave a demonstration out.
void RequireDemos(const DemoFile& file, const DemoRows& rows, const std::string& table) {
  for (const auto& [demo, first] : rows) {
    bool known = false;
    for (const std::string& name : file.demos()) known = known || name == demo;
    if (!known)
      model::segments::FailAtLine(table, first.front().line,
                                  "there is no demonstration '" + demo + "'");
  }
}

}  // namespace

ConversionReport FromRobomimic(const tasks::TaskFile& task, const FromRobomimicOptions& options,
                               const Conversion::Say& say, const std::atomic<bool>* stop) {
  const DemoFile file(options.file, options.camera);
  Conversion conversion(task, options.out, say, stop);
  const DemoRows rows = model::segments::ReadDemoCsv(options.segments, conversion.action_names());
  RequireDemos(file, rows, options.segments);
  SaySize(file, task.spec, say);
  Progress progress("demonstrations", static_cast<int>(file.demos().size()));
  for (const std::string& demo : file.demos()) {
    conversion.Try(demo, [&] {
      const auto said = rows.find(demo);
      if (said == rows.end()) throw model::DataError(options.segments + ": says nothing of it");
      Recording recording;
      recording.name = demo;
      recording.number = NumberOf(demo);
      recording.world_version = "demonstrations";
      recording.path = options.segments;
      recording.segmentation = model::segments::FromFrames(said->second, options.segments);
      recording.every = options.every;
      recording.tick_seconds = task.spec.tick_seconds;
      recording.part = file.part(demo);
      DemoPictures pictures(file, demo);
      conversion.Take(std::move(recording), &pictures);
    });
    progress.Step();
  }
  return conversion.Finish(options.file, {});
}

}  // namespace prospect::tools
