#include "model/segments/trial_labels.h"

#include <algorithm>

#include "base/hash.h"

namespace prospect::model::segments {
namespace {

/// Index of the span that `frame` belongs to: the latest that has begun; -1 before the first.
int SpanOf(const std::vector<Span>& spans, int frame) {
  const auto next =
      std::upper_bound(spans.begin(), spans.end(), frame,
                       [](int value, const Span& span) { return value < span.first; });
  return static_cast<int>(next - spans.begin()) - 1;
}

int ActionAt(const std::vector<Span>& spans, int index, int none) {
  return index < 0 ? none : spans[static_cast<std::size_t>(index)].action;
}

}  // namespace

std::uint64_t NumberOfName(const std::string& name) {
  return base::Mix64(base::HashText(name)) % (kLastRecordedNumber + 1);
}

KeptFrames::KeptFrames(const Segmentation& segmentation, int every)
    : first_(segmentation.used_from), last_(segmentation.last()), every_(every) {
  for (const Span& span : segmentation.spans) begins_.push_back(span.first);
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

void PutLabels(const Segmentation& segmentation, const std::vector<int>& frames, Trial* trial) {
  const std::vector<Span>& spans = segmentation.spans;
  for (const int frame : frames) {
    const int s = SpanOf(spans, frame);
    trial->actions.push_back(ActionAt(spans, s, trial->null_action()));
    trial->prev_action.push_back(ActionAt(spans, s - 1, trial->null_action()));
    trial->segment.push_back(s);
  }
  const bool succeeded = spans.back().succeeded;
  trial->rewards.assign(frames.size(), 0.0F);
  trial->rewards.back() = succeeded ? 1.0F : -1.0F;
  trial->dones.assign(frames.size(), 0);
  trial->dones.back() = 1;
  for (const Span& span : spans) trial->segment_succeeded.push_back(span.succeeded ? 1 : 0);
  trial->outcome = succeeded ? "success" : "failure";
  trial->reason = spans.back().cause;
}

}  // namespace prospect::model::segments
