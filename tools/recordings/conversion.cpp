#include "tools/recordings/conversion.h"

#include <algorithm>

#include "base/exit_error.h"
#include "base/hash.h"
#include "model/dataset.h"
#include "model/segments/trial_labels.h"

namespace prospect::tools {

using model::DataError;
using model::segments::KeptFrames;

Conversion::Conversion(const tasks::TaskFile& task, const std::string& out, const Say& say,
                       const std::atomic<bool>* stop)
    : task_(task), say_(say), stop_(stop), writer_(out) {}

std::vector<std::string> Conversion::action_names() const {
  std::vector<std::string> names;
  for (const sim::ActionSpec& action : task_.spec.actions) names.push_back(action.name);
  return names;
}

void Conversion::Try(const std::string& name, const std::function<void()>& take) {
  try {
    take();
  } catch (const DataError& error) {
    writer_.Drop();
    ++report_.left_out;
    say_(name + ": left out: " + error.what());
  }
}

void Conversion::Take(Recording recording, Pictures* pictures) {
  RequireWhole(recording);
  if (recording.before) {
    auto& actions = recording.segmentation;
    actions.used_from = std::max(0, actions.first() - recording.every);
  }
  model::Trial trial = Shape(recording);
  writer_.Begin(trial, KeptFrames(recording.segmentation, recording.every).Count());
  const std::vector<int> kept = CopyFrames(&recording, pictures);
  RequireWhole(recording);
  trial.plan_length = PlanLength(static_cast<int>(recording.segmentation.spans.size()));
  model::segments::PutLabels(recording.segmentation, kept, &trial);
  writer_.End(trial);
  done_.emplace(recording.name, trial.seed);
  if (recording.part) parts_[trial.seed] = *recording.part;
  ++report_.trials;
  report_.frames += trial.frames();
  if (!recording.segmentation.repairs.empty()) ++report_.repaired;
  for (const std::string& repair : recording.segmentation.repairs)
    say_(recording.name + ": repaired: " + recording.path + ": " + repair);
}

ConversionReport Conversion::Finish(const std::string& source,
                                    const std::vector<std::string>& held_out) {
  if (done_.empty()) throw DataError(source + ": none of its trials can be used");
  const bool asked = !held_out.empty() || parts_.empty();
  writer_.Commit(asked ? model::segments::AssignParts(done_, held_out) : parts_);
  return report_;
}

// All of the trial but its labels.
model::Trial Conversion::Shape(const Recording& recording) const {
  const sim::TaskSpec& spec = task_.spec;
  model::Trial trial;
  trial.seed = recording.number;
  trial.simulated = false;
  trial.name = recording.name;
  trial.task = spec.name;
  trial.world_version = recording.world_version;
  trial.width = spec.image_width;
  trial.height = spec.image_height;
  trial.tick_seconds = recording.tick_seconds;
  trial.num_actions = static_cast<int>(spec.actions.size());
  trial.present.assign(spec.actions.size(), 1);
  // Of what is only foretold a recording shows what followed what, and a table says no more.
  if (!task_.only_predicted) trial.successors = spec.successors;
  trial.task_hash = base::HexText(spec.Hash());
  return trial;
}

// Returns the numbers of the frames that were copied. A recording that ends early cuts what is said
// of it.
std::vector<int> Conversion::CopyFrames(Recording* recording, Pictures* pictures) {
  const KeptFrames keeps(recording->segmentation, recording->every);
  std::vector<int> kept;
  std::vector<std::uint8_t> rgb;
  for (int frame = 0; frame <= keeps.last(); ++frame) {
    if (stop_->load()) throw Interrupted("interrupted; nothing was written");
    const bool good =
        pictures->Next() && (!keeps.Keeps(frame) ||
                             pictures->Get(task_.spec.image_width, task_.spec.image_height, &rgb));
    if (!good) {
      model::segments::CutAtFrame(frame, recording->path, &recording->segmentation);
      break;
    }
    if (!keeps.Keeps(frame)) continue;
    writer_.AddFrame(rgb.data());
    kept.push_back(frame);
  }
  return kept;
}

// How a trial ended must be known, where its actions are planned.
void Conversion::RequireWhole(const Recording& recording) const {
  if (task_.only_predicted) return;
  const auto& spans = recording.segmentation.spans;
  const int actions = static_cast<int>(spans.size());
  const int shortest = *std::min_element(task_.plan_lengths.begin(), task_.plan_lengths.end());
  if (!spans.back().succeeded || actions >= shortest) return;
  throw DataError(recording.path + ": line " + std::to_string(spans.back().line) +
                  ": the last of " + std::to_string(actions) +
                  " actions succeeded, and a plan has " + std::to_string(shortest) +
                  ": whether the task was done is not known");
}

// Of the plan that so many actions carried out, or began.
int Conversion::PlanLength(int actions) const {
  if (task_.only_predicted) return actions;
  int longest = 0, fits = 0;
  for (const int length : task_.plan_lengths) {
    longest = std::max(longest, length);
    if (length >= actions && (fits == 0 || length < fits)) fits = length;
  }
  return fits > 0 ? fits : longest;
}

}  // namespace prospect::tools
