#include "services/console/viewer_feed.h"

#include <algorithm>

namespace prospect::services::console {
namespace {

using nlohmann::json;

constexpr std::int64_t kBusMs = 500, kMetaMs = 200, kStalledMs = 1000;

Frame PictureFrame(json header, const Picture& picture) {
  header["w"] = picture.width;
  header["h"] = picture.height;
  const std::string text = Dump(header);
  Frame frame{true, {}};
  frame.data.reserve(4 + text.size() + picture.rgb.size());
  for (int i = 0; i < 4; ++i) frame.data.push_back(static_cast<char>(text.size() >> (8 * i)));
  frame.data += text;
  frame.data.append(picture.rgb.begin(), picture.rgb.end());
  return frame;
}

}  // namespace

std::string Dump(const json& value) {
  return value.dump(-1, ' ', false, json::error_handler_t::replace);
}

void ViewerFeed::Watch(std::int64_t search_id) {
  watched_ = search_id;
  wanted_.clear();
}

void ViewerFeed::Want(std::int64_t search_id, const planner::Path& path) {
  if (wanted_.size() >= kMostWanted) wanted_.pop_front();
  wanted_.push_back({search_id, path});
}

void ViewerFeed::NoteNews(const ConsoleModel& model) {
  if (news_utime_ == 0) news_utime_ = model.newest_utime();
}

std::int64_t ViewerFeed::DueMs(std::int64_t now_ms) const {
  std::int64_t due = bus_ms_ + kBusMs;
  if (data_ms_ + kPeriodMs > now_ms) due = data_ms_ + kPeriodMs;
  if (picture_held_) due = std::min(due, picture_ms_ + kPictureMs);
  if (meta_held_) due = std::min(due, meta_ms_ + kMetaMs);
  return std::clamp<std::int64_t>(due - now_ms, 1, kBusMs);
}

std::optional<Frame> ViewerFeed::Next(ConsoleModel& model, std::int64_t now_ms) {
  // Asked only when the viewer has taken the message before: so a gap is a viewer that stalled.
  if (asked_ms_ > 0 && now_ms - asked_ms_ > kStalledMs)
    stalled_s_ += 1e-3 * static_cast<double>(now_ms - asked_ms_);
  asked_ms_ = now_ms;
  if (model.generation() != generation_) BeginAnew(model.generation());
  if (auto frame = Data(model, now_ms)) return frame;
  if (auto frame = Camera(model, now_ms)) return frame;
  if (auto frame = Seen(model)) return frame;
  return Imagined(model);
}

// A log that is played from another place is another model, of which nothing was told yet.
void ViewerFeed::BeginAnew(std::uint64_t generation) {
  generation_ = generation;
  told_search_ = 0;
  told_rows_ = told_meta_ = told_state_ = told_pictures_ = 0;
  began_ = false;
  seen_episode_ = -1;
  bus_ms_ = meta_ms_ = data_ms_ = 0;
}

std::optional<Frame> ViewerFeed::Data(ConsoleModel& model, std::int64_t now_ms) {
  if (now_ms - data_ms_ < kPeriodMs && !more_rows_) return std::nullopt;
  json message = json::object();
  if (!began_ || told_state_ != model.state_revision()) {
    message["state"] = model.State();
    told_state_ = model.state_revision();
  }
  AddSearch(model, &message);
  AddBus(model, now_ms, &message);
  AddMissed(now_ms, &message);
  const std::int64_t oldest = news_utime_;
  news_utime_ = 0;
  began_ = true;
  if (message.empty()) return std::nullopt;
  message["t"] = "data";
  message["now"] = model.now_us();
  message["happening"] = model.Happening();
  if (oldest > 0) message["oldest"] = oldest;
  data_ms_ = now_ms;
  return Frame{false, Dump(message)};
}

void ViewerFeed::AddSearch(ConsoleModel& model, json* message) {
  SearchView* search = watched_ == 0 ? model.Latest() : model.Find(watched_);
  if (!search) {
    if (told_search_ != 0) (*message)["search"] = nullptr;
    told_search_ = 0;
    more_rows_ = false;
    return;
  }
  const bool other =
      told_search_ != search->root().search_id || told_epoch_ != search->root().epoch;
  if (other) {
    told_search_ = search->root().search_id;
    told_epoch_ = search->root().epoch;
    told_rows_ = told_meta_ = 0;
    meta_ms_ = 0;
  }
  const json rows = search->Rows(&told_rows_, kRowsPerMessage);
  more_rows_ = told_rows_ != search->latest_change();
  if (!rows.empty()) (*message)["rows"] = rows;
  const bool stale = told_meta_ != search->revision();
  const bool due = meta_ms_ == 0 || asked_ms_ - meta_ms_ >= kMetaMs || search->stopped();
  meta_held_ = stale && !due;
  if (stale && due) {
    (*message)["search"] = search->Meta(model.now_us());
    told_meta_ = search->revision();
    meta_ms_ = asked_ms_;
  }
  if (message->contains("rows")) (*message)["of"] = std::to_string(told_search_);
  if (other) (*message)["fresh"] = true;
}

void ViewerFeed::AddBus(ConsoleModel& model, std::int64_t now_ms, json* message) {
  if (bus_ms_ > 0 && now_ms - bus_ms_ < kBusMs) return;
  bus_ms_ = now_ms;
  (*message)["bus"] = model.Bus();
}

void ViewerFeed::AddMissed(std::int64_t, json* message) {
  if (missed_pictures_ == told_missed_ && stalled_s_ == 0) return;
  if (message->empty() && stalled_s_ == 0) return;
  (*message)["missed"] = {{"pictures", missed_pictures_}, {"stalled_s", Short(stalled_s_)}};
  told_missed_ = missed_pictures_;
  stalled_s_ = 0;
}

std::optional<Frame> ViewerFeed::Camera(ConsoleModel& model, std::int64_t now_ms) {
  const EpisodeView& episode = model.episode();
  picture_held_ = false;
  if (episode.pictures() == told_pictures_ || !episode.camera()) return std::nullopt;
  picture_held_ = now_ms - picture_ms_ < kPictureMs;
  if (picture_held_) return std::nullopt;
  const std::uint64_t passed = episode.pictures() - told_pictures_;
  if (told_pictures_ > 0 && episode.pictures() > told_pictures_)
    missed_pictures_ += static_cast<std::int64_t>(passed) - 1;
  told_pictures_ = episode.pictures();
  picture_ms_ = now_ms;
  return PictureFrame({{"k", "camera"},
                       {"episode", std::to_string(episode.id())},
                       {"frame", episode.frame()},
                       {"utime", episode.picture_utime()}},
                      *episode.camera());
}

std::optional<Frame> ViewerFeed::Seen(ConsoleModel& model) {
  const EpisodeView& episode = model.episode();
  if (seen_episode_ != episode.id() || seen_ > episode.acts().size())
    seen_episode_ = episode.id(), seen_ = 0;
  if (seen_ >= episode.acts().size() || !episode.acts()[seen_].seen) return std::nullopt;
  const std::size_t act = seen_++;
  return PictureFrame({{"k", "seen"}, {"episode", std::to_string(episode.id())}, {"act", act}},
                      *episode.acts()[act].seen);
}

std::optional<Frame> ViewerFeed::Imagined(ConsoleModel& model) {
  for (auto wanted = wanted_.begin(); wanted != wanted_.end(); ++wanted) {
    const PicturePtr picture = model.pictures().Find(PictureKey(wanted->search_id, wanted->path));
    if (!picture) continue;
    const json header = {{"k", "imagined"},
                         {"search", std::to_string(wanted->search_id)},
                         {"path", PathText(wanted->path)}};
    wanted_.erase(wanted);
    return PictureFrame(header, *picture);
  }
  return std::nullopt;
}

}  // namespace prospect::services::console
