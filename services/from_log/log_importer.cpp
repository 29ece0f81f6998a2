#include "services/from_log/log_importer.h"

#include "lcmtypes/checked_codec.h"
#include "lcmtypes/validate.h"
#include "model/dataset.h"
#include "services/common/channels.h"

namespace prospect::services {

template <class T>
std::optional<T> LogImporter::Decode(const LogEvent& event) {
  auto result = messages::CheckedDecode<T>(event.bytes.data(), event.bytes.size());
  const std::string reason = result.ok() ? messages::Validate(result.value) : result.reason;
  if (reason.empty()) return std::move(result.value);
  ++refused_[event.channel + ": " + reason];
  return std::nullopt;
}

template <class T>
void LogImporter::TakeFrame(const LogEvent& event) {
  const std::optional<T> message = Decode<T>(event);
  if (!message) return;
  RecordedRun& run = RunOf(message->episode_id, message->frame);
  run.Add(*message);
  if (task_) run.SetTask(task_);
}

// On actions: it belongs to a run whose pictures are known.
template <class T>
void LogImporter::TakeWord(const LogEvent& event) {
  const std::optional<T> word = Decode<T>(event);
  if (!word) return;
  for (RecordedRun* run : {current_.get(), previous_.get()}) {
    if (run && run->episode_id() == word->episode_id) return run->Add(*word);
  }
}

void LogImporter::Take(const LogEvent& event) {
  if (event.channel == ChannelOf<observation_t>()) {
    TakeFrame<observation_t>(event);
  } else if (event.channel == ChannelOf<label_t>()) {
    TakeFrame<label_t>(event);
  } else if (event.channel == ChannelOf<action_status_t>()) {
    TakeWord<action_status_t>(event);
  } else if (event.channel == ChannelOf<verdict_t>()) {
    TakeWord<verdict_t>(event);
  } else if (event.channel == ChannelOf<task_t>()) {
    if (auto task = Decode<task_t>(event)) task_ = std::make_shared<task_t>(std::move(*task));
  }
}

RecordedRun& LogImporter::RunOf(std::int64_t episode_id, std::int64_t frame) {
  const bool again = frame == 0 && current_ && current_->last_frame() > 0;
  if (current_ && current_->episode_id() == episode_id && !again) return *current_;
  if (previous_ && previous_->episode_id() == episode_id && frame > 0) return *previous_;
  if (previous_) Finish(*previous_);
  previous_ = std::move(current_);
  current_ = std::make_unique<RecordedRun>(episode_id);
  return *current_;
}

void LogImporter::EndOfLog() {
  if (previous_) Finish(*previous_);
  previous_.reset();
  if (current_) Finish(*current_);
  current_.reset();
}

void LogImporter::Finish(RecordedRun& run) { rows_.push_back(Import(run)); }

ImportRow LogImporter::Import(RecordedRun& run) {
  ImportRow row{run.episode_id(), static_cast<std::int64_t>(run.pictures()), "refused", ""};
  try {
    const model::Trial trial = run.ToTrial();
    // Episodes of a robot whose ids are long may come to one number.
    if (numbers_.contains(trial.seed))
      throw RunError(trial.simulated ? "this scene was recorded before and is kept already"
                                     : "an episode numbered " + std::to_string(trial.seed) +
                                           " is kept already");
    sink_(trial);
    numbers_.insert(trial.seed);
    return {row.episode_id, trial.frames(), trial.outcome, trial.reason};
  } catch (const RunError& error) {
    row.reason = error.what();
  } catch (const model::DataError& error) {
    row.reason = error.what();
  }
  return row;
}

}  // namespace prospect::services
