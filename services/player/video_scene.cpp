#include "services/player/video_scene.h"

#include <algorithm>
#include <cmath>

#include "model/jigsaws/gestures.h"
#include "planner/path.h"
#include "report/video_reader.h"
#include "services/binding/task_messages.h"

namespace prospect::services {
namespace {

using model::jigsaws::kGestures;
using model::segments::Span;

constexpr double kGestureLimit = 60;  // seconds that a gesture may take

/// Index of the gesture that `frame` belongs to; -1 before the first.
int SpanOf(const std::vector<Span>& spans, int frame) {
  const auto later =
      std::upper_bound(spans.begin(), spans.end(), frame,
                       [](int value, const Span& span) { return value < span.first; });
  return static_cast<int>(later - spans.begin()) - 1;
}

int ActionOf(const std::vector<Span>& spans, int index) {
  return index < 0 ? kGestures : spans[static_cast<std::size_t>(index)].action;
}

}  // namespace

task_t GestureTask(const std::string& name, double tick_seconds) {
  task_t task{};
  task.name = name;
  task.world_version = "video";
  for (int action = 0; action < kGestures; ++action) task.initial.push_back(action);
  task.num_initial = kGestures;
  for (int action = 0; action < kGestures; ++action) {
    action_t row{};
    row.index = action;
    row.name = model::jigsaws::GestureName(action);
    row.kind = model::jigsaws::GestureWords(action);
    row.successors = task.initial;
    row.num_successors = kGestures;
    task.actions.push_back(row);
  }
  task.num_actions = kGestures;
  task.plan_length = planner::kMaxPathLength;  // a video may hold more gestures
  task.repeats_allowed = 1;
  task.image_width = model::jigsaws::kWidth;
  task.image_height = model::jigsaws::kHeight;
  task.tick_seconds = tick_seconds;
  task.action_time_limit = kGestureLimit;
  task.task_hash = TaskHash(task);
  return task;
}

VideoScene::VideoScene(const VideoChoice& choice, std::int64_t episode_id) : choice_(choice) {
  Restart(episode_id);
  seconds_per_frame_ = 1.0 / video_->frames_per_second();
  task_ = GestureTask(choice.task, seconds_per_frame_ * choice.every);
  if (choice.transcription.empty()) return;
  std::vector<std::string> names;
  for (const action_t& action : task_.actions) names.push_back(action.name);
  transcription_ = model::segments::ReadTranscription(choice.transcription, names);
}

VideoScene::~VideoScene() = default;

void VideoScene::Restart(std::int64_t episode_id) {
  video_ = std::make_unique<report::VideoReader>(choice_.video);
  at_ = -1;
  observation_ = observation_t{};
  observation_.episode_id = episode_id;
  observation_.frame = -1;
  label_.reset();
}

bool VideoScene::Shows(int frame) const {
  if (frame % choice_.every == 0) return true;
  if (!transcription_) return false;
  const auto& spans = transcription_->spans;
  return std::any_of(spans.begin(), spans.end(),
                     [frame](const Span& span) { return span.first == frame; });
}

bool VideoScene::Next() {
  do {
    if (!video_->Next()) return false;
    ++at_;
  } while (!Shows(at_));
  if (!video_->Picture(task_.image_width, task_.image_height, &observation_.data)) return false;
  Describe(at_);
  return true;
}

void VideoScene::Describe(int frame) {
  observation_t& o = observation_;
  ++o.frame;
  o.sim_time_us = std::llround(1e6 * seconds_per_frame_ * frame);
  o.encoding = observation_t::ENCODING_RGB8;
  o.width = task_.image_width;
  o.height = task_.image_height;
  o.num_bytes = static_cast<std::int32_t>(o.data.size());
  if (!transcription_) return;
  const auto& spans = transcription_->spans;
  int next = frame + 1;
  while (!Shows(next)) ++next;
  const int span = SpanOf(spans, frame);
  label_t label{};
  label.sim_time_us = o.sim_time_us;
  label.episode_id = o.episode_id;
  label.frame = o.frame;
  label.seed = -1;
  label.action = ActionOf(spans, span);
  label.previous_action = ActionOf(spans, span - 1);
  label.segment = span;
  label.segment_end = span >= 0 && SpanOf(spans, next) != span ? 1 : 0;
  label.outcome = label_t::OUTCOME_RUNNING;
  label.light = 1;
  label.present.assign(kGestures, 1);
  label.num_present = kGestures;
  label_ = label;
}

}  // namespace prospect::services
