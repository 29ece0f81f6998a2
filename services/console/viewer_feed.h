#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "services/console/console_model.h"

namespace prospect::services::console {

/// One message to a page: JSON as text, or a picture: four bytes, low first, with the length of a
/// JSON header, the header, and the picture's bytes.
struct Frame {
  bool binary = false;
  std::string data;
};

/// What one viewer was told already, and what it is to be told next. Nothing is queued for a
/// viewer: each message is made of what changed since the last one at the moment when the viewer
/// can take it. So one that stalls costs no memory and no time; when it reads on, it gets what is
/// so then, and is told what it missed. One thread at a time, with the model.
class ViewerFeed {
 public:
  static constexpr std::int64_t kPeriodMs = 80;    ///< between two messages of data
  static constexpr std::int64_t kPictureMs = 100;  ///< between two camera pictures: 10 a second
  static constexpr std::size_t kRowsPerMessage = 2000;
  static constexpr std::size_t kMostWanted = 512;

  /// The search whose nodes are told; 0: always the latest.
  void Watch(std::int64_t search_id);
  /// An imagined picture that the page wants to show, told once it is there.
  void Want(std::int64_t search_id, const planner::Path& path);

  /// To be called when something was heard: how long the viewer's data wait is counted from then.
  void NoteNews(const ConsoleModel& model);

  /// The next message. Nothing: there is no news, or it is not time yet: DueMs() says when to ask.
  /// @param now_ms steady clock
  std::optional<Frame> Next(ConsoleModel& model, std::int64_t now_ms);

  /// Milliseconds until Next() may have something that it holds back now; at most 500.
  std::int64_t DueMs(std::int64_t now_ms) const;

  std::int64_t missed_pictures() const { return missed_pictures_; }

 private:
  void BeginAnew(std::uint64_t generation);
  std::optional<Frame> Data(ConsoleModel& model, std::int64_t now_ms);
  std::optional<Frame> Camera(ConsoleModel& model, std::int64_t now_ms);
  std::optional<Frame> Seen(ConsoleModel& model);
  std::optional<Frame> Imagined(ConsoleModel& model);
  void AddSearch(ConsoleModel& model, nlohmann::json* message);
  void AddBus(ConsoleModel& model, std::int64_t now_ms, nlohmann::json* message);
  void AddMissed(std::int64_t now_ms, nlohmann::json* message);

  struct Wanted {
    std::int64_t search_id;
    planner::Path path;
  };

  std::uint64_t generation_ = 0;
  std::int64_t watched_ = 0;  // 0: the latest
  std::int64_t told_search_ = 0;
  std::int32_t told_epoch_ = 0;
  std::uint64_t told_rows_ = 0, told_meta_ = 0, told_state_ = 0, told_pictures_ = 0;
  bool began_ = false, more_rows_ = false, picture_held_ = false, meta_held_ = false;
  std::int64_t news_utime_ = 0;  // of the oldest message that may not be told yet; 0: none
  std::int64_t data_ms_ = 0, bus_ms_ = 0, meta_ms_ = 0, picture_ms_ = 0, asked_ms_ = 0;
  std::int64_t missed_pictures_ = 0, told_missed_ = 0;
  double stalled_s_ = 0;
  std::int64_t seen_episode_ = -1;
  std::size_t seen_ = 0;
  std::deque<Wanted> wanted_;
};

/// Text of JSON, whatever bytes its strings hold.
std::string Dump(const nlohmann::json& value);

}  // namespace prospect::services::console
