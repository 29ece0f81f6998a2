#pragma once

#include <algorithm>
#include <cstdint>
#include <list>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "services/console/episode_view.h"
#include "services/console/picture_store.h"
#include "services/console/search_view.h"
#include "services/console/services_view.h"
#include "services/console/traffic.h"

namespace prospect::services::console {

/// A message, from the bus or from a log.
struct BusEvent {
  std::int64_t utime = 0;  ///< when it was received or logged, microseconds since the epoch
  std::string channel;
  std::vector<std::uint8_t> bytes;  ///< without a key's tag
  std::string refused;              ///< why it is not to be believed; empty: it is
};

/// All that a page shows, from messages of a bus or of a log in the same way. What it holds is
/// bounded: of searches the oldest are dropped, of imagined pictures those that nobody looked at
/// for longest; both are counted. One thread at a time (console_server.h guards it by a mutex).
class ConsoleModel {
 public:
  static constexpr std::size_t kUsualBytes = 128u << 20;

  /// @param bytes what the whole process may hold, about
  /// @param generation tells this model from others that stood in its place
  explicit ConsoleModel(std::size_t bytes = kUsualBytes, std::uint64_t generation = 1);

  std::uint64_t generation() const { return generation_; }

  void Take(const BusEvent& event);

  /// Time that "alive" and rates are judged by: that of the latest message, or later.
  void Advance(std::int64_t now_us) { now_us_ = std::max(now_us_, now_us); }
  std::int64_t now_us() const { return now_us_; }

  /// Grows with every message: whether there is anything to tell at all.
  std::uint64_t revision() const { return revision_; }
  /// Grows with what State() tells.
  std::uint64_t state_revision() const;
  /// utime of the newest message that was taken, for latencies.
  std::int64_t newest_utime() const { return newest_utime_; }

  /// Task, episode, big state, list of searches.
  nlohmann::json State();
  /// Services, servers, channels.
  nlohmann::json Bus();
  /// What is happening: "nobody", "idle", "thinking", "acting", "deciding", "refused", "solved",
  /// "failed", "stopped", "done".
  std::string Happening() const;

  /// Null: unknown, or dropped.
  SearchView* Find(std::int64_t search_id);
  /// The latest; null: none yet.
  SearchView* Latest();
  /// Whether a search is under way.
  bool Searching() const;

  EpisodeView& episode() { return episode_; }
  const EpisodeView& episode() const { return episode_; }
  PictureStore& pictures() { return pictures_; }
  ServicesView& services() { return services_; }
  const std::optional<task_t>& task() const { return task_; }
  std::int64_t dropped_searches() const { return dropped_searches_; }
  /// What searches and pictures take, about.
  std::size_t bytes() const;

 private:
  std::string Dispatch(const BusEvent& event);
  std::string DispatchSearch(const BusEvent& event);
  void OnTask(const task_t& task);
  void OnObservation(const observation_t& seen);
  void OnHealth(const health_t& health, std::int64_t now_us);
  void OnStop(const search_stop_t& stop, std::int64_t now_us);
  SearchView* Growing(std::int64_t search_id);
  void OnRoot(const search_root_t& root, std::int64_t now_us);
  void OnPicture(const predict_reply_t& reply);
  void DropOldest();

  std::uint64_t generation_;
  std::size_t most_search_bytes_;
  std::uint64_t revision_ = 0, state_revision_ = 0;
  std::int64_t now_us_ = 0, newest_utime_ = 0;
  std::int64_t dropped_searches_ = 0;
  std::optional<task_t> task_;
  std::list<std::unique_ptr<SearchView>> searches_;  // oldest first
  EpisodeView episode_;
  ServicesView services_;
  PictureStore pictures_;
  Traffic traffic_;
};

}  // namespace prospect::services::console
