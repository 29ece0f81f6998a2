#include "services/executive/search_session.h"

#include <spdlog/spdlog.h>

#include <algorithm>

#include "cli/installation.h"
#include "services/binding/search_table.h"
#include "services/binding/task_messages.h"
#include "services/common/ids.h"

namespace prospect::services {
namespace {

constexpr std::int64_t kAnnounceMs = 100;
constexpr std::int64_t kSilentMs = 3000;
constexpr std::int64_t kStalledMs = 10000;
constexpr std::int64_t kClosingMs = 200;
constexpr std::int64_t kStopRepeatMs = 20;
constexpr std::int64_t kFetchMs = 500;
constexpr int kMissingAtOnce = 64;
// Enough for one of each first action to be among them.
constexpr int kListedFutures = 4096;

}  // namespace

SearchSession::SearchSession(Conversation& talk) : talk_(talk), window_(talk.id()) {
  subscriptions_.push_back(
      talk_.bus().Subscribe<expand_reply_t>([this](const expand_reply_t& reply) {
        if (!shared_) return;
        if (first_answer_us_ == 0 && !reply.evaluations.empty() &&
            shared_->Concerns(reply.search_id, reply.epoch))
          first_answer_us_ = SteadyUs();
        shared_->Hear(reply);
        window_.Hear(reply, SteadyMs());
      }));
  subscriptions_.push_back(
      talk_.bus().Subscribe<search_statistics_t>([this](const search_statistics_t& statistics) {
        if (shared_) shared_->Hear(statistics, SteadyUs());
      }));
}

void SearchSession::Begin(const SearchQuestion& question) {
  question_ = question;
  root_ = question.root;
  root_.executive_id = talk_.id();
  root_.search_id = RandomId();
  root_.budget_ms = question.budget_ms;
  started_ms_ = SteadyMs();
  shared_ = std::make_unique<SharedSearch>(root_, RulesOfSearch(*talk_.view().task(), root_),
                                           talk_.id(), 0, started_ms_ * 1000, kListedFutures);
  window_.Begin(root_, started_ms_);
  ended_by_.clear();
  first_answer_us_ = over_us_ = 0;
  servers_heard_ms_ = workers_heard_ms_ = progress_ms_ = started_ms_;
  progress_ = 0;
}

bool SearchSession::ServersReady() const {
  const auto live = talk_.view().servers().Live(root_.weights_hash, SteadyMs());
  return !live.empty() && std::all_of(live.begin(), live.end(), [&](const model_info_t& info) {
    return info.search_id == root_.search_id && info.epoch == root_.epoch;
  });
}

void SearchSession::HandOutPictures() {
  for (auto* image : {&question_.first, &question_.present}) {
    image->executive_id = talk_.id();
    image->search_id = root_.search_id;
    talk_.Say(*image);
    if (question_.first.image_id == question_.present.image_id) return;
  }
}

void SearchSession::Announce() {
  if (question_.budget_ms >= 0) {
    root_.budget_ms = std::max<std::int64_t>(0, question_.budget_ms - (SteadyMs() - started_ms_));
  }
  talk_.Say(root_);
  if (!ServersReady()) HandOutPictures();
}

void SearchSession::RequireLife() {
  const std::int64_t now_ms = SteadyMs();
  if (!talk_.view().servers().Live(root_.weights_hash, now_ms).empty()) servers_heard_ms_ = now_ms;
  if (!talk_.monitor().Alive("worker").empty()) workers_heard_ms_ = now_ms;
  const std::int64_t progress =
      shared_->search().total_rollouts() + shared_->search().known_evaluations();
  if (progress != progress_) progress_ = progress, progress_ms_ = now_ms;
  // The lists of the living already wait for the silence to last, so a short grace is enough.
  const char* lost = nullptr;
  if (now_ms - servers_heard_ms_ > kSilentMs / 3) lost = "no servers";
  if (now_ms - workers_heard_ms_ > kSilentMs / 3) lost = "no workers";
  if (now_ms - progress_ms_ > kStalledMs) lost = "no progress";
  if (!lost) return;
  Stop(lost);
  throw ExitError(kExitServiceLost, std::string("the search ended without an answer: ") + lost +
                                        "; see the services' logs, then " + cli::Typed("up"));
}

bool SearchSession::Over() {
  RequireLife();
  const auto& search = shared_->search();
  const std::int64_t now_us = SteadyUs();
  const auto reason = search.stop_reason(now_us);
  const bool enough = search.total_rollouts() >= question_.samples;
  if (enough) {
    ended_by_ = "samples";
  } else if (reason == planner::StopReason::kExhausted ||
             reason == planner::StopReason::kDeadline) {
    ended_by_ = planner::ToString(reason);
  } else if (AllFinal()) {
    ended_by_ = "finished";
  }
  return !ended_by_.empty();
}

bool SearchSession::AllFinal() const {
  const auto& statistics = shared_->search().statistics();
  bool any = false;
  for (const auto& writer : statistics.writers()) {
    if (writer.id == statistics.writer() || !writer.live) continue;
    if (!writer.announced.finished || !writer.Converged()) return false;
    any = true;
  }
  return any;
}

void SearchSession::Stop(const std::string& reason) {
  search_stop_t stop{};
  stop.executive_id = talk_.id();
  stop.search_id = root_.search_id;
  stop.epoch = root_.epoch;
  stop.reason = reason;
  talk_.Say(stop);
}

void SearchSession::CloseRound(const std::string& reason) {
  Stop(reason);
  talk_.Until([this] { return AllFinal(); }, kClosingMs, [&] { Stop(reason); }, kStopRepeatMs);
}

// A reply that got lost on its way here was heard by others, who went on: without it this process
// might read off another plan.
void SearchSession::FetchMissing() {
  const auto ask = [this] {
    const std::int64_t now_ms = SteadyMs();
    window_.Ask(shared_->search().MissingEvaluations(kMissingAtOnce), talk_.view().servers(),
                now_ms);
    for (auto& request : window_.TakeDue(talk_.view().servers(), now_ms)) talk_.Say(request);
  };
  const auto whole = [this] { return shared_->search().MissingEvaluations(1).empty(); };
  if (!talk_.Until(whole, kFetchMs, ask, kStopRepeatMs))
    spdlog::warn("some evaluations were never heard");
}

std::vector<planner::Path> SearchSession::Unknown(const std::vector<planner::Path>& paths) const {
  const auto& search = shared_->search();
  std::vector<planner::Path> unknown;
  for (const auto& path : paths) {
    const auto id = search.paths().Find(path);
    if (id == planner::kNoPath || !search.evaluation_table().Has(id)) unknown.push_back(path);
  }
  return unknown;
}

std::map<planner::Path, planner::Evaluation> SearchSession::Evaluate(
    const std::vector<planner::Path>& paths) {
  // The search is over, and so may be the time that it had.
  search_root_t unhurried = root_;
  unhurried.budget_ms = -1;
  window_.Begin(unhurried, SteadyMs());
  const auto ask = [&] {
    const std::int64_t now_ms = SteadyMs();
    window_.Ask(Unknown(paths), talk_.view().servers(), now_ms);
    for (auto& request : window_.TakeDue(talk_.view().servers(), now_ms)) talk_.Say(request);
  };
  const auto whole = [&] { return Unknown(paths).empty(); };
  if (!talk_.Until(whole, kStalledMs, ask, kStopRepeatMs)) {
    throw ExitError(kExitServiceLost, "the model servers did not evaluate " +
                                          NamesOf(*talk_.view().task(), Unknown(paths)[0]) +
                                          " within 10 s; see their logs");
  }
  const auto& search = shared_->search();
  std::map<planner::Path, planner::Evaluation> evaluations;
  for (const auto& path : paths)
    evaluations[path] = search.evaluation_table().Get(search.paths().Find(path));
  return evaluations;
}

SearchAnswer SearchSession::Collect(std::int64_t started_ms) const {
  const auto& search = shared_->search();
  SearchAnswer answer;
  answer.plan = search.BestPlan();
  answer.ended_by = ended_by_;
  answer.rollouts = search.total_rollouts();
  answer.evaluations = search.known_evaluations();
  answer.workers = 0;
  for (const auto& writer : search.statistics().writers()) {
    if (writer.id == search.statistics().writer()) continue;
    answer.requested += writer.announced.evaluations;
    ++answer.workers;
  }
  answer.converged = AllFinal();
  answer.search_id = root_.search_id;
  answer.epoch = root_.epoch;
  answer.table = TableHash(search);
  answer.seconds = static_cast<double>(SteadyMs() - started_ms) / 1000;
  if (first_answer_us_ > 0)
    answer.searching_seconds = 1e-6 * static_cast<double>(over_us_ - first_answer_us_);
  return answer;
}

SearchAnswer SearchSession::Search(const SearchQuestion& question) {
  Begin(question);
  try {
    const std::int64_t for_ever = 24 * 3600 * 1000;
    talk_.Until([this] { return Over(); }, for_ever, [this] { Announce(); }, kAnnounceMs);
  } catch (const ExitError& error) {
    Stop(error.code() == kExitInterrupted ? "interrupted" : "service lost");
    throw;
  }
  over_us_ = SteadyUs();
  CloseRound(ended_by_ == "deadline" ? "deadline" : "budget");
  FetchMissing();
  return Collect(started_ms_);
}

}  // namespace prospect::services
