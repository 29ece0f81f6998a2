#pragma once

#include <cstdint>
#include <map>

namespace prospect::services {

/// How the servers behave as seen from one client: how long each says that a path waits with it,
/// and which have fallen silent. A server is a suspect when a request to it went unanswered for its
/// whole time-out and nothing else was heard from it meanwhile; it is one no more as soon as it is
/// heard. So a server's death costs one time-out, not one for each request. Time is an argument
/// (milliseconds of any steady clock). One thread.
class ServerConduct {
 public:
  /// A reply of this server, to whomever, that promises `wait_ms`.
  void NoteReply(std::int64_t server, double wait_ms, std::int64_t now_ms) {
    servers_[server] = {now_ms, wait_ms, false};
  }

  /// A request to this server, sent at `sent_ms`, timed out.
  void NoteTimeout(std::int64_t server, std::int64_t sent_ms) {
    Server& entry = servers_[server];
    if (entry.heard_ms < sent_ms) entry.suspect = true;
  }

  bool Suspect(std::int64_t server) const {
    const auto found = servers_.find(server);
    return found != servers_.end() && found->second.suspect;
  }

  /// Milliseconds; 0 when it never said.
  double WaitMs(std::int64_t server) const {
    const auto found = servers_.find(server);
    return found == servers_.end() ? 0 : found->second.wait_ms;
  }

  /// A new search: what servers said about waiting in the one before is stale, their silence is
  /// not.
  void ForgetWaits() {
    for (auto& [id, server] : servers_) server.wait_ms = 0;
  }

 private:
  struct Server {
    std::int64_t heard_ms = -1;
    double wait_ms = 0;
    bool suspect = false;
  };
  std::map<std::int64_t, Server> servers_;
};

}  // namespace prospect::services
