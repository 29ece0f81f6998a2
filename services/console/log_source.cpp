#include "services/console/log_source.h"

#include <algorithm>
#include <set>

#include "lcmtypes/checked_codec.h"
#include "services/common/channels.h"
#include "services/common/clock.h"

namespace prospect::services::console {
namespace {

using nlohmann::json;

// How long a turn may read, so that viewers are answered meanwhile.
constexpr std::int64_t kTurnUs = 40'000;
constexpr double kSlowest = 0.1, kFastest = 10;

// Moments that "step" goes to: searches begin and end, actions begin and end, plans are made.
class Marks {
 public:
  bool IsOne(const LogEvent& event) {
    if (event.channel == ChannelOf<plan_t>()) return true;
    if (event.channel == ChannelOf<search_root_t>()) return First<search_root_t>(event, &searches_);
    if (event.channel == ChannelOf<search_stop_t>()) return First<search_stop_t>(event, &stops_);
    if (event.channel != ChannelOf<action_status_t>()) return false;
    const auto status =
        messages::CheckedDecode<action_status_t>(event.bytes.data(), event.bytes.size());
    if (!status.ok()) return false;
    const std::pair<std::int64_t, int> now{status.value.command_id, status.value.state};
    return now != std::exchange(status_, now);
  }

 private:
  template <class T>
  static bool First(const LogEvent& event, std::set<std::int64_t>* known) {
    const auto message = messages::CheckedDecode<T>(event.bytes.data(), event.bytes.size());
    return message.ok() && known->insert(message.value.search_id).second;
  }

  std::set<std::int64_t> searches_, stops_;
  std::pair<std::int64_t, int> status_{-1, -1};
};

}  // namespace

LogSource::LogSource(std::string path, std::size_t memory_bytes, std::function<void()> notify)
    : path_(std::move(path)), memory_bytes_(memory_bytes), notify_(std::move(notify)) {
  Scan();
  Begin();
}

void LogSource::Scan() {
  EventLog log(path_);
  Marks marks;
  bool any = false;
  for (LogEvent event; log.Next(event); any = true) {
    if (!any) first_us_ = event.utime;
    last_us_ = std::max(last_us_, event.utime);
    if (marks.IsOne(event)) marks_.push_back(event.utime - first_us_);
  }
  damaged_ = log.damaged();
  std::sort(marks_.begin(), marks_.end());
  marks_.erase(std::unique(marks_.begin(), marks_.end()), marks_.end());
}

void LogSource::Begin() {
  log_ = std::make_unique<EventLog>(path_);
  more_ = log_->Next(next_);
  at_us_ = 0;
  const std::lock_guard<std::mutex> lock(mutex());
  model_ = std::make_unique<ConsoleModel>(memory_bytes_, ++generation_);
}

// @return whether it is there, and not merely out of time
bool LogSource::ReadUntil(std::int64_t utime, std::int64_t deadline_us) {
  const std::lock_guard<std::mutex> lock(mutex());
  while (more_ && next_.utime <= utime) {
    model_->Take({next_.utime, next_.channel, std::move(next_.bytes), ""});
    more_ = log_->Next(next_);
    if (SteadyUs() > deadline_us) return false;
  }
  model_->Advance(utime);
  return true;
}

void LogSource::Seek(std::int64_t at_us) {
  goal_us_ = std::clamp<std::int64_t>(at_us, 0, last_us_ - first_us_);
  if (goal_us_ < at_us_) Begin();
}

void LogSource::Step(int by) {
  playing_ = false;
  if (by > 0) {
    const auto next = std::upper_bound(marks_.begin(), marks_.end(), goal_us_);
    return Seek(next == marks_.end() ? last_us_ - first_us_ : *next);
  }
  const auto here = std::lower_bound(marks_.begin(), marks_.end(), goal_us_);
  Seek(here == marks_.begin() ? 0 : *std::prev(here));
}

void LogSource::Tick() {
  const std::int64_t now_us = SteadyUs();
  const std::int64_t length_us = last_us_ - first_us_;
  if (playing_ && ticked_us_ > 0) {
    const double passed = speed_ * static_cast<double>(now_us - ticked_us_);
    goal_us_ = std::min(length_us, goal_us_ + static_cast<std::int64_t>(passed));
    if (goal_us_ == length_us) playing_ = false;
  }
  ticked_us_ = now_us;
  if (at_us_ == goal_us_ && !playing_) return;
  const bool there = ReadUntil(first_us_ + goal_us_, now_us + kTurnUs);
  if (there) at_us_ = goal_us_;
  if (!there && more_) at_us_ = std::max(at_us_, next_.utime - first_us_ - 1);
  notify_();
}

std::string LogSource::Do(const std::string& what, const json& request) {
  if (what == "play") {
    playing_ = request.at("playing").get<bool>();
    speed_ = std::clamp(request.value("speed", speed_), kSlowest, kFastest);
    if (playing_ && goal_us_ >= last_us_ - first_us_) Seek(0);
    return "";
  }
  if (what == "seek") return Seek(request.at("at_us").get<std::int64_t>()), "";
  if (what == "step") return Step(request.at("by").get<int>()), "";
  return "a recording cannot do that";
}

json LogSource::Facts() {
  return {{"kind", "log"},
          {"file", path_.substr(path_.rfind('/') + 1)},
          {"length_us", last_us_ - first_us_},
          {"at_us", goal_us_},
          {"reading", at_us_ != goal_us_},
          {"playing", playing_},
          {"speed", speed_},
          {"marks", marks_.size()},
          {"damaged", damaged_},
          {"begun_us", first_us_},
          {"control", false}};
}

}  // namespace prospect::services::console
