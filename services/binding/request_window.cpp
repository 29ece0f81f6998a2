#include "services/binding/request_window.h"

#include <algorithm>
#include <cmath>

#include "lcmtypes/validate.h"
#include "services/binding/evaluation_messages.h"

namespace prospect::services {
namespace {

// Weight of a new measurement in the smoothed answering time, as in TCP's estimate (RFC 6298).
constexpr double kSmoothing = 0.125, kSpreadSmoothing = 0.25, kSpreads = 4;
constexpr int kMostDoublings = 5;
constexpr std::size_t kPathsPerRequest = messages::kMaxPathsPerRequest;

}  // namespace

void RequestWindow::Begin(const search_root_t& root, std::int64_t now_ms) {
  search_id_ = root.search_id;
  epoch_ = root.epoch;
  weights_hash_ = root.weights_hash;
  deadline_ms_ = root.budget_ms < 0 ? -1 : now_ms + root.budget_ms;
  requests_.clear();
  conduct_.ForgetWaits();
}

void RequestWindow::Hurry(std::int64_t now_ms) {
  for (auto& [id, request] : requests_) request.due_ms = now_ms;
}

bool RequestWindow::Awaits(const planner::Path& path) const {
  return std::any_of(requests_.begin(), requests_.end(), [&](const auto& entry) {
    const auto& paths = entry.second.paths;
    return std::find(paths.begin(), paths.end(), path) != paths.end();
  });
}

void RequestWindow::Ask(const std::vector<planner::Path>& paths, const ServerList& servers,
                        std::int64_t now_ms) {
  std::map<std::int64_t, std::int64_t> open;  // server -> request id
  for (const auto& path : paths) {
    if (Awaits(path)) continue;
    const std::int64_t server = servers.Choose(path, 0, weights_hash_, now_ms, conduct_);
    auto [entry, fresh] = open.try_emplace(server, next_id_);
    if (!fresh && requests_[entry->second].paths.size() >= kPathsPerRequest) {
      entry->second = next_id_;
      fresh = true;
    }
    if (fresh) requests_[next_id_++].due_ms = now_ms;
    requests_[entry->second].paths.push_back(path);
  }
}

std::int64_t RequestWindow::Timeout(int attempt) const {
  const auto usual = static_cast<std::int64_t>(answer_ms_ + kSpreads * spread_ms_);
  const std::int64_t first = std::max(kFirstTimeoutMs, usual);
  return std::min(kLongestTimeoutMs,
                  first << std::min(std::max(attempt, backoff_), kMostDoublings));
}

expand_request_t RequestWindow::Message(std::int64_t id, const Request& request,
                                        std::int64_t now_ms) const {
  expand_request_t message{};
  message.client_id = client_id_;
  message.request_id = id;
  message.attempt = request.attempt;
  message.server_id = request.server;
  message.search_id = search_id_;
  message.epoch = epoch_;
  message.weights_hash = weights_hash_;
  message.budget_ms = deadline_ms_ < 0 ? -1 : std::max<std::int64_t>(0, deadline_ms_ - now_ms);
  for (const auto& path : request.paths) message.paths.push_back(ToMessage(path));
  message.num_paths = static_cast<std::int32_t>(message.paths.size());
  return message;
}

std::vector<expand_request_t> RequestWindow::TakeDue(const ServerList& servers,
                                                     std::int64_t now_ms) {
  std::vector<expand_request_t> due;
  for (auto& [id, request] : requests_) {
    if (request.due_ms > now_ms) continue;
    if (request.attempt > 0) {
      ++resent_;
      backoff_ = std::max(backoff_, std::min(request.attempt, kMostDoublings));
      conduct_.NoteTimeout(request.server, request.sent_ms);
    }
    request.server =
        servers.Choose(request.paths.front(), request.attempt, weights_hash_, now_ms, conduct_);
    due.push_back(Message(id, request, now_ms));
    request.sent_ms = now_ms;
    request.due_ms = now_ms + Timeout(request.attempt);
    ++request.attempt;
  }
  return due;
}

void RequestWindow::Forget(const std::vector<evaluation_t>& evaluations, std::int64_t now_ms) {
  for (auto it = requests_.begin(); it != requests_.end();) {
    auto& paths = it->second.paths;
    const auto answered = [&](const planner::Path& path) {
      return std::any_of(evaluations.begin(), evaluations.end(),
                         [&](const evaluation_t& e) { return e.path.actions == path; });
    };
    std::erase_if(paths, answered);
    if (!paths.empty()) {
      ++it;
      continue;
    }
    // Only a first attempt says how long an answer takes: a later one may be answered by the
    // first's reply (Karn's rule).
    if (it->second.attempt == 1) {
      const double off = static_cast<double>(now_ms - it->second.sent_ms) - answer_ms_;
      backoff_ = 0;
      answer_ms_ += kSmoothing * off;
      spread_ms_ += kSpreadSmoothing * (std::abs(off) - spread_ms_);
    }
    it = requests_.erase(it);
  }
}

bool RequestWindow::Concerns(const expand_reply_t& reply) const {
  return reply.search_id == search_id_ && reply.epoch == epoch_;
}

std::vector<planner::Path> RequestWindow::Hear(const expand_reply_t& reply, std::int64_t now_ms) {
  if (!Concerns(reply)) return {};
  conduct_.NoteReply(reply.server_id, reply.wait_ms, now_ms);
  Forget(reply.evaluations, now_ms);
  if (reply.status == expand_reply_t::STATUS_OK) return {};
  std::vector<planner::Path> refused;
  for (std::size_t i = 0; i < reply.request_ids.size(); ++i) {
    const auto request = requests_.find(reply.request_ids[i]);
    if (reply.client_ids[i] != client_id_ || request == requests_.end()) continue;
    if (reply.retry_ms > 0) {
      request->second.due_ms = now_ms + reply.retry_ms;
    } else {
      auto& paths = request->second.paths;
      refused.insert(refused.end(), paths.begin(), paths.end());
      requests_.erase(request);
    }
  }
  return refused;
}

std::int64_t RequestWindow::Remaining(std::int64_t now_ms, std::int64_t otherwise) const {
  std::int64_t remaining = otherwise;
  for (const auto& [id, request] : requests_) {
    remaining = std::min(remaining, std::max<std::int64_t>(0, request.due_ms - now_ms));
  }
  return remaining;
}

std::size_t RequestWindow::awaited_paths() const {
  std::size_t count = 0;
  for (const auto& [id, request] : requests_) count += request.paths.size();
  return count;
}

}  // namespace prospect::services
