#include "tests/faults/search_observer.h"

#include <algorithm>

#include "services/binding/statistics_messages.h"
#include "services/binding/task_messages.h"
#include "services/common/clock.h"
#include "services/common/ids.h"

namespace prospect::tests {

using services::SteadyMs;

SearchObserver::SearchObserver(services::Bus& bus) {
  subscriptions_.push_back(bus.Subscribe<task_t>([this](const task_t& task) { task_ = task; }));
  subscriptions_.push_back(
      bus.Subscribe<search_root_t>([this](const search_root_t& root) { OnRoot(root); }));
  subscriptions_.push_back(bus.Subscribe<search_statistics_t>(
      [this](const search_statistics_t& s) { OnStatistics(s); }));
  subscriptions_.push_back(
      bus.Subscribe<expand_reply_t>([this](const expand_reply_t& reply) { OnReply(reply); }));
}

void SearchObserver::OnRoot(const search_root_t& root) {
  if (!task_ || (search_ && search_->Concerns(root.search_id, root.epoch))) return;
  search_ = std::make_unique<services::SharedSearch>(root, services::RulesOfSearch(*task_, root),
                                                     services::RandomId(), 0, SteadyMs() * 1000);
  all_.clear();
  by_writer_.clear();
  relayed_.clear();
  evaluated_.clear();
  first_reply_ms_.clear();
}

void SearchObserver::OnStatistics(const search_statistics_t& statistics) {
  if (!search_ || !search_->Concerns(statistics.search_id, statistics.epoch)) return;
  search_->Hear(statistics, SteadyMs() * 1000);
  Note(rollouts(), &all_);
  Note(statistics.rollouts, &by_writer_[statistics.writer]);
  for (const auto& row : services::FromMessage(statistics).rows) {
    if (!row.path.empty()) continue;
    auto& known = relayed_[{statistics.writer, static_cast<std::int64_t>(row.writer)}];
    known = std::max(known, row.visits);
  }
}

void SearchObserver::OnReply(const expand_reply_t& reply) {
  if (!search_ || !search_->Concerns(reply.search_id, reply.epoch)) return;
  for (const auto& evaluation : reply.evaluations) evaluated_.insert(evaluation.path.actions);
  if (!reply.evaluations.empty()) first_reply_ms_.emplace(reply.server_id, SteadyMs());
}

void SearchObserver::Note(std::int64_t rollouts, Timeline* timeline) {
  if (timeline->empty() || rollouts > timeline->back().rollouts)
    timeline->push_back({SteadyMs(), rollouts});
}

std::int64_t SearchObserver::At(const Timeline& timeline, std::int64_t at_ms) {
  std::int64_t rollouts = 0;
  for (const Moment& moment : timeline) {
    if (moment.at_ms > at_ms) break;
    rollouts = moment.rollouts;
  }
  return rollouts;
}

std::int64_t SearchObserver::rollouts() const {
  return search_ ? search_->search().total_rollouts() : 0;
}

double SearchObserver::RolloutRate(std::int64_t from_ms, std::int64_t to_ms) const {
  const auto made = static_cast<double>(At(all_, to_ms) - At(all_, from_ms));
  return 1000 * made / static_cast<double>(to_ms - from_ms);
}

std::optional<planner::WriterView> SearchObserver::View(std::int64_t writer) const {
  if (!search_) return std::nullopt;
  for (const auto& view : search_->search().statistics().writers()) {
    if (view.id == static_cast<std::uint64_t>(writer)) return view;
  }
  return std::nullopt;
}

std::int64_t SearchObserver::in_flight() const {
  return search_ ? search_->search().statistics().totals(planner::kRoot).in_flight : 0;
}

std::int64_t SearchObserver::Relayed(std::int64_t relay, std::int64_t writer) const {
  const auto found = relayed_.find({relay, writer});
  return found == relayed_.end() ? 0 : found->second;
}

std::int64_t SearchObserver::FirstReplyMs(std::int64_t server) const {
  const auto found = first_reply_ms_.find(server);
  return found == first_reply_ms_.end() ? 0 : found->second;
}

std::int64_t SearchObserver::LongestStallMs(std::int64_t writer, std::int64_t since_ms,
                                            std::int64_t to_ms) const {
  std::int64_t longest = 0;
  std::int64_t last_ms = since_ms;
  const auto found = by_writer_.find(writer);
  if (found != by_writer_.end()) {
    for (const Moment& moment : found->second) {
      if (moment.at_ms <= since_ms || moment.at_ms > to_ms) continue;
      longest = std::max(longest, moment.at_ms - last_ms);
      last_ms = moment.at_ms;
    }
  }
  return std::max(longest, to_ms - last_ms);
}

}  // namespace prospect::tests
