#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "lcmtypes/messages.h"
#include "planner/path.h"
#include "services/binding/server_conduct.h"
#include "services/binding/server_list.h"

namespace prospect::services {

/// The EXPAND_REQUESTs of one client that await their evaluations. A request that stays unanswered
/// is sent again after 20, 40, 80, ... ms (never sooner than the usual answering time and four
/// times its spread; after a time-out new requests wait as long as the resent one, until one is
/// answered at the first attempt: RFC 6298, 5.5 to 5.7), each time to the next server in its rank;
/// servers answer a repeat from memory, and two evaluations of one path are the same. A server that
/// says BUSY is asked again after its hint. Time is an argument (milliseconds of any steady clock).
/// One thread.
class RequestWindow {
 public:
  static constexpr std::int64_t kFirstTimeoutMs = 20;
  static constexpr std::int64_t kLongestTimeoutMs = 640;

  /// @param client_id the writer id of a worker, or any random id
  explicit RequestWindow(std::int64_t client_id) : client_id_(client_id) {}

  /// A new search: forgets what was asked for in the one before. Requests tell what is left of its
  /// budget.
  void Begin(const search_root_t& root, std::int64_t now_ms = 0);

  /// Sends everything awaited again at the next TakeDue: a server has come that was not there.
  void Hurry(std::int64_t now_ms);

  /// Asks for these paths, one request for each server concerned. Paths already awaited are not
  /// asked for twice.
  void Ask(const std::vector<planner::Path>& paths, const ServerList& servers, std::int64_t now_ms);

  /// What is to be sent now: new requests and overdue ones, with attempt and server filled in.
  std::vector<expand_request_t> TakeDue(const ServerList& servers, std::int64_t now_ms);

  /// Takes note of an answer, whoever it was meant for: its paths are no longer awaited. Returns
  /// the paths of ours that a server refuses for good, which will never come.
  std::vector<planner::Path> Hear(const expand_reply_t& reply, std::int64_t now_ms);

  /// Milliseconds until something is overdue; `otherwise` when nothing is awaited.
  std::int64_t Remaining(std::int64_t now_ms, std::int64_t otherwise) const;

  /// Whether `path` was asked for and has not come yet.
  bool Awaits(const planner::Path& path) const;
  std::size_t awaited_paths() const;
  std::int64_t resent() const { return resent_; }

 private:
  struct Request {
    std::vector<planner::Path> paths;
    int attempt = 0;
    std::int64_t sent_ms = 0;
    std::int64_t due_ms = 0;
    std::int64_t server = 0;  // asked last
  };

  expand_request_t Message(std::int64_t id, const Request& request, std::int64_t now_ms) const;
  void Forget(const std::vector<evaluation_t>& evaluations, std::int64_t now_ms);
  bool Concerns(const expand_reply_t& reply) const;
  std::int64_t Timeout(int attempt) const;

  std::int64_t client_id_;
  std::int64_t search_id_ = 0;
  std::int32_t epoch_ = 0;
  std::int64_t weights_hash_ = 0;
  std::int64_t next_id_ = 1;
  std::int64_t deadline_ms_ = -1;  // of the search; negative: none
  double answer_ms_ = 10;          // usual answering time, and how far answers stray from it
  double spread_ms_ = 0;
  int backoff_ = 0;  // doublings that new requests begin with
  ServerConduct conduct_;
  std::int64_t resent_ = 0;
  std::map<std::int64_t, Request> requests_;  // by request id
};

}  // namespace prospect::services
