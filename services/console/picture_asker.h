#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <unordered_set>

#include "lcmtypes/messages.h"
#include "planner/path.h"

namespace prospect::services::console {

/// Decides when a model server is asked for which imagined picture: one at a time, and few a second
/// while a search runs, since a picture takes the time of a batch's rows. What a server refuses or
/// does not answer is not asked for again. Time is an argument (steady clock, milliseconds); pure
/// but for `say`. One thread.
class PictureAsker {
 public:
  static constexpr std::int64_t kWhileSearchingMs = 250, kTimeoutMs = 1000;
  static constexpr std::size_t kMostWaiting = 512;

  /// @param client_id of the requests @param say publishes one
  PictureAsker(std::int64_t client_id, std::function<void(const predict_request_t&)> say)
      : client_id_(client_id), say_(std::move(say)) {}

  struct Wish {
    std::int64_t search_id;
    std::int32_t epoch;
    planner::Path path;
  };

  /// Urgent ones come first, in their order: a model server holds only the latest searches. Of the
  /// others the latest, which are what is in view. Each is asked for once.
  void Want(const Wish& wish, bool urgent);
  /// An answer of a server, to whomever.
  void Hear(const predict_reply_t& reply);
  /// @param searching whether a search is under way @param there whether somebody has this picture
  /// by now
  void Turn(std::int64_t now_ms, bool searching, const std::function<bool(const Wish&)>& there);

 private:
  std::deque<Wish>* Line() { return urgent_.empty() ? &waiting_ : &urgent_; }

  std::int64_t client_id_;
  std::function<void(const predict_request_t&)> say_;
  std::deque<Wish> urgent_, waiting_;
  std::unordered_set<std::string> known_;  // asked for, or waiting
  std::optional<Wish> asked_;
  std::int64_t request_id_ = 0, asked_ms_ = -kTimeoutMs;
  int attempt_ = 0;
};

}  // namespace prospect::services::console
