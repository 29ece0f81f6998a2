#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "services/common/bus.h"

namespace prospect::tests {

/// Hears the whole bus and keeps what tests ask about. One thread; Poll through Until().
class Witness {
 public:
  Witness();

  /// Listens until `condition` holds. @return false when it did not within `timeout_ms`. `repeat`
  /// is called about every 20 ms.
  bool Until(const std::function<bool()>& condition, int timeout_ms,
             const std::function<void()>& repeat = nullptr);

  /// Listens for the given time, for what must not happen.
  void Listen(int milliseconds);

  /// Latest HEALTH of live instances of a service.
  std::vector<health_t> Services(const std::string& service) const;
  bool Ready(const std::string& service, int count) const;

  services::Bus bus;
  std::vector<action_command_t> commands;
  std::vector<action_status_t> statuses;
  std::vector<plan_t> plans;
  std::vector<search_root_t> roots;
  std::vector<search_stop_t> stops;
  std::vector<expand_reply_t> replies;
  std::map<std::int64_t, label_t> labels;       // by frame of the latest episode
  std::map<std::int64_t, std::int64_t> finals;  // writer -> digest of its latest final rows
  std::map<std::int64_t, health_t> health;      // by instance, latest
  std::int64_t episode_id = -1;                 // of the latest LABEL

 private:
  template <class T>
  void Keep(std::vector<T>* list);

  std::vector<services::Subscription> subscriptions_;
};

/// A new folder for one test's files, below the build's folder.
std::string MakeFolder(const std::string& name);

std::string ReadText(const std::string& path);

}  // namespace prospect::tests
