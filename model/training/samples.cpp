#include "model/training/samples.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "model/training/random.h"

namespace prospect::model {
namespace {

constexpr double kUnsureSeconds =
    0.3;  // frames nearer to an action's end are neither done nor not done
constexpr std::uint64_t kMidStream = 0x6d6964;  // "mid"

constexpr float kUnknown = std::numeric_limits<float>::infinity();

/// Gives each frame of one trial its slot, once.
class Slots {
 public:
  Slots(const Trial& trial, int number, SampleSet* set)
      : trial_(trial), number_(number), set_(set) {}
  int Of(int frame) {
    const auto [found, is_new] = slots_.emplace(frame, static_cast<int>(set_->frames.size()));
    if (is_new) Add(frame);
    return found->second;
  }

 private:
  void Add(int frame) {
    set_->frames.push_back({number_, frame});
    if (trial_.num_landmarks == 0) {
      set_->landmarks.insert(set_->landmarks.end(),
                             static_cast<std::size_t>(set_->num_landmarks) * 2, kUnknown);
      return;
    }
    const auto begin = trial_.landmarks.begin() + frame * trial_.num_landmarks * 2;
    set_->landmarks.insert(set_->landmarks.end(), begin, begin + trial_.num_landmarks * 2);
  }

  const Trial& trial_;
  int number_;
  SampleSet* set_;
  std::map<int, int> slots_;
};

std::vector<int> ChooseMids(const Trial& trial, const SegmentSpan& span, int count) {
  const int margin =
      std::max(1, static_cast<int>(std::ceil(kUnsureSeconds / trial.tick_seconds - 1e-9)));
  const int room = span.goal - margin - span.first;  // frames first+1 .. goal-margin
  std::vector<int> mids;
  CounterRandom random(trial.seed, kMidStream, static_cast<std::uint64_t>(span.first));
  for (int k = 0; k < count && room > 0; ++k) {
    mids.push_back(span.first + 1 + static_cast<int>(random.Below(room)));
  }
  return mids;
}

void RequireSameKind(const Trial& trial, const SampleSet& set) {
  if (trial.task != set.task || trial.task_hash != set.task_hash || trial.width != set.width ||
      trial.height != set.height || trial.num_actions != set.num_actions ||
      (trial.num_landmarks > 0 && trial.num_landmarks != set.num_landmarks)) {
    throw DataError(
        "trial of seed " + std::to_string(trial.seed) +
        ": another task, action table, number of landmarks or picture size than the first trial's");
  }
}

/// Trials of a real robot say nothing of landmarks and may come before those that do.
void AllowLandmarks(int count, SampleSet* set) {
  if (set->num_landmarks > 0 || count == 0) return;
  set->num_landmarks = count;
  set->landmarks.assign(set->frames.size() * static_cast<std::size_t>(count) * 2, kUnknown);
}

template <typename Items, typename SplitOfItem>
std::vector<int> IndicesOf(const Items& items, Split split, const SplitOfItem& split_of) {
  std::vector<int> indices;
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (split_of(items[i]) == split) indices.push_back(static_cast<int>(i));
  }
  return indices;
}

}  // namespace

std::vector<SegmentSpan> SegmentSpans(const Trial& trial) {
  std::vector<SegmentSpan> spans(static_cast<std::size_t>(trial.segments()));
  for (int i = trial.frames() - 1; i >= 0; --i) {
    const int s = trial.segment[static_cast<std::size_t>(i)];
    if (s >= 0) spans[static_cast<std::size_t>(s)].first = i;
  }
  for (std::size_t s = 0; s < spans.size(); ++s) {
    spans[s].goal = s + 1 < spans.size() ? spans[s + 1].first : trial.frames() - 1;
  }
  return spans;
}

std::vector<int> SampleSet::TrialsOf(Split split) const {
  std::vector<int> indices;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    if (trials[i].split == split && trials[i].segments > 0) indices.push_back(static_cast<int>(i));
  }
  return indices;
}

std::vector<int> SampleSet::SegmentsOf(Split split) const {
  return IndicesOf(segments, split, [this](const SegmentSample& s) {
    return trials[static_cast<std::size_t>(s.trial)].split;
  });
}

std::vector<int> SampleSet::FramesOf(Split split) const {
  return IndicesOf(frames, split, [this](const FrameRef& f) {
    return trials[static_cast<std::size_t>(f.trial)].split;
  });
}

void AddTrial(const Trial& trial, std::size_t index, int mids_per_segment, SampleSet* set) {
  if (set->trials.empty()) {
    set->task = trial.task;
    set->world_version = trial.world_version;
    set->task_hash = trial.task_hash;
    set->width = trial.width;
    set->height = trial.height;
    set->num_actions = trial.num_actions;
    set->successors = trial.successors;
  }
  AllowLandmarks(trial.num_landmarks, set);
  RequireSameKind(trial, *set);
  const int number = static_cast<int>(set->trials.size());
  Slots slots(trial, number, set);
  TrialSample sample;
  sample.seed = trial.seed;
  sample.index = index;
  sample.split = trial.part();
  sample.succeeded = trial.succeeded();
  sample.first = slots.Of(0);
  sample.present = trial.present;
  sample.first_segment = static_cast<int>(set->segments.size());
  sample.segments = trial.segments();
  const std::vector<SegmentSpan> spans = SegmentSpans(trial);
  for (std::size_t s = 0; s < spans.size(); ++s) {
    const auto first = static_cast<std::size_t>(spans[s].first);
    SegmentSample segment;
    segment.trial = number;
    segment.action = trial.actions[first];
    segment.previous = trial.prev_action[first];
    segment.start = slots.Of(spans[s].first);
    segment.goal = slots.Of(spans[s].goal);
    segment.succeeded = trial.segment_succeeded[s] > 0;
    for (const int frame : ChooseMids(trial, spans[s], mids_per_segment)) {
      segment.mids.push_back(slots.Of(frame));
    }
    set->segments.push_back(std::move(segment));
  }
  set->trials.push_back(std::move(sample));
}

bool MayFollow(const SampleSet& set, const TrialSample& trial, int previous, int next) {
  if (trial.present[static_cast<std::size_t>(next)] == 0) return false;
  if (set.successors.empty()) return next != previous;
  const std::vector<int>& row = set.successors[static_cast<std::size_t>(previous)];
  return std::find(row.begin(), row.end(), next) != row.end();
}

SampleSet ReadSamples(const TrialFile& file, int mids_per_segment) {
  SampleSet set;
  for (std::size_t i = 0; i < file.size(); ++i) {
    AddTrial(file.ReadLabels(i), i, mids_per_segment, &set);
  }
  return set;
}

}  // namespace prospect::model
