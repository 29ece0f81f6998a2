#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "lcmtypes/messages.h"

namespace prospect::services::console {

/// Who is on the bus, by HEALTH and MODEL_INFO: state, queue, batches, evaluations a second. Times
/// are microseconds of the messages' clock. One thread at a time.
class ServicesView {
 public:
  void Hear(const health_t& health, std::int64_t now_us);
  void Hear(const model_info_t& info, std::int64_t now_us);

  /// Rows of those heard in the last minute, and the model servers among them.
  nlohmann::json ToJson(std::int64_t now_us);

  /// Alive: heard in the last 3 s, and not leaving. @param service "worker", "executive", ...
  int Alive(const std::string& service, std::int64_t now_us) const;
  /// Process ids of those that are alive on a machine.
  std::vector<int> PidsOn(const std::string& host, const std::string& service,
                          std::int64_t now_us) const;
  /// The model server that answers for these weights; 0: any.
  std::int64_t AnyServer(std::int64_t weights_hash, std::int64_t now_us) const;
  /// Paths that wait at the busiest server.
  int Queue(std::int64_t now_us) const;

 private:
  struct Peer {
    health_t health;
    std::int64_t heard_us = 0;
  };
  struct Server {
    model_info_t info, then;
    std::int64_t heard_us = 0, then_us = 0;
    double evaluations_per_second = 0;
  };

  static bool Alive(const Peer& peer, std::int64_t now_us);
  void Forget(std::int64_t now_us);

  std::map<std::int64_t, Peer> peers_;
  std::map<std::int64_t, Server> servers_;
};

}  // namespace prospect::services::console
