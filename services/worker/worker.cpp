#include "services/worker/worker.h"

#include <spdlog/spdlog.h>

#include <algorithm>

#include "services/binding/evaluation_messages.h"
#include "services/binding/statistics_messages.h"
#include "services/binding/task_messages.h"

namespace prospect::services {
namespace {

// SEARCH_ROOT repeats at 10 Hz: ten missing in a row mean that nobody wants the answer any more.
constexpr std::int64_t kRootSilenceMs = 1000;
constexpr std::int64_t kClosingMs = 500;
constexpr std::int64_t kLongestWaitMs = 100;
constexpr std::size_t kRememberedStops = 256;
constexpr int kMissingAtOnce = 64;

}  // namespace

Worker::Worker(Bus& bus, const WorkerOptions& options)
    : bus_(bus),
      options_(options),
      health_(bus, "worker"),
      window_(health_.instance_id()),
      statistics_due_(options.statistics_period_ms) {
  if (options_.index < 0) options_.index = health_.instance_id() % 65536;
  if (!options_.journal.empty()) {
    journal_ = std::make_unique<Journal>(options_.journal, health_.instance_id(),
                                         static_cast<int>(options_.index));
  }
  subscriptions_.push_back(bus_.Subscribe<task_t>([this](const task_t& task) { OnTask(task); }));
  subscriptions_.push_back(
      bus_.Subscribe<model_info_t>([this](const model_info_t& info) { OnInfo(info); }));
  subscriptions_.push_back(
      bus_.Subscribe<search_root_t>([this](const search_root_t& root) { OnRoot(root); }));
  subscriptions_.push_back(
      bus_.Subscribe<search_stop_t>([this](const search_stop_t& stop) { OnStop(stop); }));
  subscriptions_.push_back(
      bus_.Subscribe<expand_reply_t>([this](const expand_reply_t& reply) { OnReply(reply); }));
  subscriptions_.push_back(bus_.Subscribe<expand_request_t>(
      [this](const expand_request_t& request) { OnRequest(request); }));
  subscriptions_.push_back(bus_.Subscribe<search_statistics_t>(
      [this](const search_statistics_t& rows) { OnStatistics(rows); }));
  health_.SetState(health_t::STATE_READY);
}

void Worker::OnTask(const task_t& task) {
  const bool news = !task_ || task_->task_hash != task.task_hash;
  task_ = task;
  if (journal_ && news) journal_->Heard(task, SteadyUs());
}

// A server that has just taken the search up (it was restarted, or came late) may hold what others
// no longer answer.
void Worker::OnInfo(const model_info_t& info) {
  servers_.Hear(info, SteadyMs());
  if (!shared_ || !shared_->Concerns(info.search_id, info.epoch)) return;
  const bool came = ready_servers_.insert(info.server_id).second;
  if (came && ready_servers_.size() > 1) window_.Hurry(SteadyMs());
}

bool Worker::Wanted(const search_root_t& root, std::int64_t now_ms) const {
  if (stopped_searches_.contains(root.search_id)) return false;
  if (!task_ || task_->task_hash != root.task_hash) return false;
  if (!shared_) return true;
  if (shared_->root().search_id == root.search_id) return root.epoch > shared_->root().epoch;
  return phase_ != Phase::kSearching || now_ms - root_heard_ms_ > kRootSilenceMs;
}

void Worker::OnRoot(const search_root_t& root) {
  const std::int64_t now_ms = SteadyMs();
  if (Wanted(root, now_ms)) Begin(root, now_ms);
  if (shared_ && shared_->Concerns(root.search_id, root.epoch)) root_heard_ms_ = now_ms;
}

void Worker::Begin(const search_root_t& root, std::int64_t now_ms) {
  if (phase_ != Phase::kIdle) Conclude();
  if (shared_) rollouts_before_ += shared_->search().rollouts();
  shared_.reset();
  try {
    shared_ =
        std::make_unique<SharedSearch>(root, RulesOfSearch(*task_, root), health_.instance_id(),
                                       static_cast<int>(options_.index), now_ms * 1000);
  } catch (const planner::GoalError& error) {
    return Refuse(root, "goals", error.what());
  } catch (const std::exception& error) {
    return Refuse(root, "parameters", error.what());
  }
  if (journal_) journal_->Begun(root, now_ms * 1000);
  window_.Begin(root, now_ms);
  subtrees_ = SubtreeCounter();
  ready_servers_.clear();
  phase_ = Phase::kSearching;
  root_heard_ms_ = now_ms;
  statistics_due_.Hurry();
  health_.SetState(health_t::STATE_BUSY);
  spdlog::debug("search {} epoch {} begins", root.search_id, root.epoch);
}

void Worker::Refuse(const search_root_t& root, const char* reason, const char* what) {
  bus_.CountRefused(ChannelOf<search_root_t>(), reason);
  spdlog::warn("search {} refused: {}", root.search_id, what);
  stopped_searches_.insert(root.search_id);
}

void Worker::OnStop(const search_stop_t& stop) {
  if (stopped_searches_.size() >= kRememberedStops) stopped_searches_.clear();
  stopped_searches_.insert(stop.search_id);
  if (phase_ == Phase::kSearching && shared_->root().search_id == stop.search_id)
    Close(stop.reason.c_str());
}

void Worker::Close(const char* why) {
  spdlog::debug("search {} ends: {}", shared_->root().search_id, why);
  shared_->search().Stop();
  if (journal_) journal_->Stopped(SteadyUs());
  window_.Begin(shared_->root(), SteadyMs());
  phase_ = Phase::kClosing;
  closing_since_ms_ = SteadyMs();
  statistics_due_.Hurry();
}

void Worker::OnReply(const expand_reply_t& reply) {
  if (!shared_ || !shared_->Concerns(reply.search_id, reply.epoch)) return;
  if (journal_) journal_->Heard(reply, SteadyUs());
  shared_->Hear(reply, &window_);
  for (const auto& path : window_.Hear(reply, SteadyMs())) {
    spdlog::warn("a server refuses {}: {}", planner::ToString(path), reply.reason);
    shared_->search().Abandon(path);
    if (journal_) journal_->Abandoned(path, SteadyUs());
  }
}

void Worker::OnRequest(const expand_request_t& request) {
  if (!shared_ || !shared_->Concerns(request.search_id, request.epoch)) return;
  const std::int64_t now_us = SteadyUs();
  if (journal_) journal_->Heard(request, now_us);
  shared_->Hear(request, health_.instance_id(), now_us);
}

void Worker::OnStatistics(const search_statistics_t& statistics) {
  if (!shared_ || !shared_->sharing()) return;
  if (!shared_->Concerns(statistics.search_id, statistics.epoch)) return;
  const std::int64_t now_us = SteadyUs();
  if (journal_) journal_->Heard(statistics, now_us);
  shared_->Hear(statistics, now_us);
}

void Worker::Advance() {
  auto& search = shared_->search();
  const int wanted = std::max(0, shared_->root().leaves - search.waiting());
  const std::int64_t now_us = SteadyUs();
  const auto asked = search.Advance(wanted, now_us);
  if (journal_) journal_->Advanced(wanted, asked, now_us);
  window_.Ask(asked, servers_, SteadyMs());
}

// Among several servers, each answers for whole subtrees.
void Worker::SpreadWork(std::int64_t now_ms) {
  const auto live = servers_.Live(shared_->root().weights_hash, now_ms).size();
  if (live < 2) return;
  const int wanted = ServerList::kSubtreesEach * static_cast<int>(live);
  servers_.SetPrefixLength(subtrees_.PrefixLength(shared_->search().paths(), wanted));
}

// Without them this worker might read off another plan than the others.
void Worker::AskForMissing(std::int64_t now_ms) {
  if (shared_->sharing())
    window_.Ask(shared_->search().MissingEvaluations(kMissingAtOnce), servers_, now_ms);
}

void Worker::SendRequests(std::int64_t now_ms) {
  for (auto& request : window_.TakeDue(servers_, now_ms)) {
    request.utime = UtimeNow();
    bus_.Publish(request);
  }
}

// At every tick, and at once where others may be waiting for this worker's word.
bool Worker::StatisticsDue(std::int64_t now_ms) {
  return statistics_due_.Due(now_ms) || shared_->search().WantsExchange();
}

void Worker::SendStatistics(std::int64_t now_ms) {
  const std::int64_t now_us = SteadyUs();
  const auto budget = static_cast<std::size_t>(options_.statistics_bytes);
  auto message = ToMessage(shared_->search().MakeBatch(budget, now_us), kLeaseMs);
  message.utime = UtimeNow();
  if (journal_) journal_->Sent(message, options_.statistics_bytes, now_us);
  bus_.Publish(message);
  SpreadWork(now_ms);
}

void Worker::CheckAbandoned(std::int64_t now_ms) {
  if (phase_ == Phase::kSearching && now_ms - root_heard_ms_ > kRootSilenceMs)
    Close("its root fell silent");
  if (phase_ == Phase::kClosing && now_ms - closing_since_ms_ >= kClosingMs) Conclude();
}

void Worker::Conclude() {
  const std::string summary = Summary(shared_->search().BestPlan(), *task_);
  spdlog::info("search {}: {} rollouts here, {} in all, {} evaluations; {}",
               shared_->root().search_id, shared_->search().rollouts(),
               shared_->search().total_rollouts(), shared_->search().evaluations(), summary);
  phase_ = Phase::kIdle;
  health_.SetState(health_t::STATE_READY,
                   "search " + std::to_string(shared_->root().search_id) + ": " + summary);
}

void Worker::Report() {
  const std::int64_t here = shared_ ? shared_->search().rollouts() : 0;
  health_.SetCounter("rollouts", rollouts_before_ + here);
  health_.SetCounter("requests resent", window_.resent());
  health_.SetQueue(static_cast<std::int32_t>(window_.awaited_paths()));
  health_.Tick();
}

int Worker::TimeoutMs(std::int64_t now_ms) const {
  if (phase_ == Phase::kIdle) return kLongestWaitMs;
  if (shared_->search().WantsExchange()) return 0;
  const std::int64_t until = std::min(kLongestWaitMs, statistics_due_.Remaining(now_ms));
  return static_cast<int>(window_.Remaining(now_ms, until));
}

void Worker::Turn() {
  bus_.Poll(TimeoutMs(SteadyMs()));
  const std::int64_t now_ms = SteadyMs();
  CheckAbandoned(now_ms);
  // Rows first: the others learn of this worker before it takes its share of the rollouts.
  if (phase_ != Phase::kIdle && StatisticsDue(now_ms)) SendStatistics(now_ms);
  if (phase_ == Phase::kSearching) Advance();
  if (phase_ == Phase::kClosing) AskForMissing(now_ms);
  if (phase_ != Phase::kIdle) SendRequests(now_ms);
  Report();
}

void Worker::Leave() {
  health_.SetState(health_t::STATE_DRAINING, "leaving");
  health_.PublishNow();
}

}  // namespace prospect::services
