#include "services/model/batch_timing.h"

#include <algorithm>

namespace prospect::services {
namespace {

constexpr double kSmoothing = 0.125;  // of round trips, as in TCP's estimate (RFC 6298)
constexpr double kFading = 0.98;      // of batches: about the last fifty count
// Round trips vary: a client counts as late beyond so many of its usual ones.
constexpr double kPatience = 2;
constexpr std::int64_t kLeastPatienceUs = 300;
constexpr std::int64_t kForgetUs = 10'000'000;
constexpr std::size_t kManyClients = 1024;
// Below this spread of batch sizes the line's slope says nothing.
constexpr double kLeastSpread = 0.25;

}  // namespace

void BatchTiming::NoteBatch(int rows, double batch_us) {
  if (rows <= 0) return;
  for (double* sum : {&n_, &x_, &xx_, &y_, &xy_}) *sum *= kFading;
  n_ += 1;
  x_ += rows;
  xx_ += static_cast<double>(rows) * rows;
  y_ += batch_us;
  xy_ += rows * batch_us;
  const double mean_rows = x_ / n_, mean_us = y_ / n_;
  const double spread = xx_ / n_ - mean_rows * mean_rows;
  if (spread < kLeastSpread) {
    // Equal batches: with the slope last known, or as if all were fixed.
    fixed_us_ = std::max(0.0, mean_us - row_us_ * mean_rows);
    return;
  }
  row_us_ = std::max(0.0, (xy_ / n_ - mean_rows * mean_us) / spread);
  fixed_us_ = std::clamp(mean_us - row_us_ * mean_rows, 0.0, mean_us);
}

std::int64_t BatchTiming::LongestUs(const Client& client) const {
  const auto patience =
      std::max(kLeastPatienceUs, static_cast<std::int64_t>(kPatience * client.round_trip_us));
  return std::min(static_cast<std::int64_t>(fixed_us_), patience);
}

void BatchTiming::DropOldClients(std::int64_t now_us) {
  if (clients_.size() < kManyClients) return;
  for (auto it = clients_.begin(); it != clients_.end();)
    it = now_us - it->second.answered_us > kForgetUs ? clients_.erase(it) : std::next(it);
}

void BatchTiming::NoteAnswered(const std::vector<std::int64_t>& clients, std::int64_t now_us) {
  DropOldClients(now_us);
  for (const std::int64_t id : clients) {
    Client& client = clients_[id];
    client.answered_us = now_us;
    client.due = true;
  }
}

void BatchTiming::NoteRequest(std::int64_t id, std::int64_t now_us) {
  Client& client = clients_[id];
  if (client.answered_us == 0) return;  // its first request answers nothing
  const auto took = static_cast<double>(now_us - client.answered_us);
  // Only the first request after an answer says how long the way there and back takes, and only a
  // prompt one: a client that had nothing to ask for a while says nothing about the way.
  if (took < std::max<double>(fixed_us_, kLeastPatienceUs)) {
    if (client.due || !client.prompt) {
      client.round_trip_us +=
          (client.round_trip_us > 0 ? kSmoothing : 1.0) * (took - client.round_trip_us);
    }
    client.prompt = true;
  }
  client.due = false;
}

std::int64_t BatchTiming::WaitUs(std::int64_t now_us) {
  std::int64_t wait = 0;
  for (auto& [id, client] : clients_) {
    if (!client.due) continue;
    const std::int64_t left = client.answered_us + LongestUs(client) - now_us;
    if (left <= 0) {
      client.due = client.prompt = false;
    } else if (client.prompt) {
      wait = std::max(wait, left);
    }
  }
  return wait;
}

}  // namespace prospect::services
