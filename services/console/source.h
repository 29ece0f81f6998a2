#pragma once

#include <cstdint>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>

#include "services/console/console_model.h"

namespace prospect::services::console {

/// Where the page's data come from, a bus or a log, and what may be asked of it. Model() is guarded
/// by mutex(); everything else is called on the I/O thread, without the mutex.
class Source {
 public:
  Source() = default;
  virtual ~Source() = default;
  Source(const Source&) = delete;
  Source& operator=(const Source&) = delete;

  std::mutex& mutex() { return mutex_; }
  virtual ConsoleModel& model() = 0;

  /// What the page must know of the source: {"kind": "bus" or "log", ...}. Its text is compared
  /// with what was told before, so it may change at any time.
  virtual nlohmann::json Facts() = 0;

  /// An imagined picture that somebody wants to see and the model does not have.
  /// @param urgent before others
  virtual void WantPicture(std::int64_t search_id, const planner::Path& path, bool urgent) = 0;

  /// What a viewer asks for besides looking ("run", "stop", "judge", "seek", ...).
  /// @return what is wrong with it, for a person; empty: it is done, or under way
  virtual std::string Do(const std::string& what, const nlohmann::json& request) = 0;

  /// Called ten times a second and more.
  virtual void Tick() = 0;

 private:
  std::mutex mutex_;
};

}  // namespace prospect::services::console
