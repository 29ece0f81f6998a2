#include "model/jigsaws/trial_labels.h"

#include <algorithm>

#include "model/dataset.h"
#include "model/jigsaws/gestures.h"

namespace prospect::model::jigsaws {
namespace {

constexpr int kMostNumbers = 1000;  // numbers of a user's trials have three digits

bool IsDigit(char c) { return c >= '0' && c <= '9'; }

/// Index of the span that `frame` belongs to: the latest that has begun.
std::size_t SpanOf(const std::vector<GestureSpan>& spans, int frame) {
  const auto next =
      std::upper_bound(spans.begin(), spans.end(), frame,
                       [](int value, const GestureSpan& span) { return value < span.first; });
  return static_cast<std::size_t>(next - spans.begin()) - 1;
}

}  // namespace

std::uint64_t TrialName::seed() const {
  return static_cast<std::uint64_t>((user - 'A') * kMostNumbers + number);
}

TrialName ParseTrialName(const std::string& folder, const std::string& text) {
  const std::string prefix = folder + "_";
  const std::string tail =
      text.substr(0, prefix.size()) == prefix ? text.substr(prefix.size()) : "";
  if (tail.size() != 4 || tail[0] < 'A' || tail[0] > 'Z' ||
      !std::all_of(tail.begin() + 1, tail.end(), IsDigit)) {
    throw DataError(text + ": is not named " + prefix + "XNNN, X the user's letter, NNN a number");
  }
  return {text, tail[0], std::stoi(tail.substr(1))};
}

KeptFrames::KeptFrames(const Transcription& transcription, int every)
    : first_(transcription.first()), last_(transcription.last()), every_(every) {
  for (const GestureSpan& span : transcription.spans) begins_.push_back(span.first);
}

bool KeptFrames::Keeps(int frame) const {
  if (frame < first_ || frame > last_) return false;
  return (frame - first_) % every_ == 0 || frame == last_ ||
         std::binary_search(begins_.begin(), begins_.end(), frame);
}

int KeptFrames::Count() const {
  int count = 0;
  for (int frame = first_; frame <= last_; ++frame) count += Keeps(frame) ? 1 : 0;
  return count;
}

Trial LabelsOf(const Transcription& transcription, const std::vector<int>& frames, int every,
               double seconds_per_frame) {
  Trial t;
  t.outcome = "success";
  t.width = kWidth;
  t.height = kHeight;
  t.tick_seconds = every * seconds_per_frame;
  t.num_actions = kGestures;
  t.present.assign(kGestures, 1);
  t.task_hash = GestureTableHash();
  for (const int frame : frames) {
    const std::size_t s = SpanOf(transcription.spans, frame);
    t.actions.push_back(transcription.spans[s].action);
    t.prev_action.push_back(s == 0 ? kGestures : transcription.spans[s - 1].action);
    t.segment.push_back(static_cast<int>(s));
    t.rewards.push_back(0.0F);
    t.dones.push_back(0);
  }
  t.rewards.back() = 1.0F;
  t.dones.back() = 1;
  t.plan_length = t.segment.back() + 1;
  t.segment_succeeded.assign(static_cast<std::size_t>(t.plan_length), 1);
  return t;
}

}  // namespace prospect::model::jigsaws
