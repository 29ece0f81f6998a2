#include "tools/bench/simulated_bus.h"

#include <algorithm>
#include <chrono>
#include <deque>
#include <map>
#include <memory>
#include <random>
#include <set>
#include <unordered_map>
#include <vector>

#include "planner/scripted_tree.h"
#include "planner/search.h"
#include "planner/statistics_codec.h"
#include "tools/bench/cpu_clock.h"
#include "tools/bench/event_queue.h"

namespace prospect::tools {
namespace {

using planner::Path;
using planner::ScriptedTree;
using planner::Search;
using planner::StatisticsBatch;
using Clock = CpuClock;

constexpr std::int64_t kLongestUs = 600'000'000;
constexpr std::int64_t kFreshUs = 100'000;
constexpr int kTopLevels = 3;
constexpr std::size_t kPlenty = 1 << 24;  // bytes, for all rows in one batch
constexpr double kMessageBytes = 60;      // of a request or reply without paths
constexpr double kPathBytes = 16;         // of a path in a request
constexpr double kAnswerBytes = 60;       // of a path's evaluation in a reply

struct Answer {
  Path path;
  planner::Evaluation evaluation;
  std::set<int> askers;
};
using Answers = std::shared_ptr<const std::vector<Answer>>;

struct Worker {
  std::unique_ptr<Search> search;
  std::int64_t busy_until_us = 0;
  double busy_us = 0;
};

class SimulatedBus {
 public:
  explicit SimulatedBus(const BusOptions& options);
  BusResult Run();

 private:
  // Workers.
  void Handle(int worker, std::int64_t time_us, std::function<double(Search*)> work);
  void Move(int worker);
  void Tick(int worker);
  void SendStatistics(int worker);
  void Receive(int worker, const std::shared_ptr<const StatisticsBatch>& batch,
               const std::shared_ptr<const std::vector<std::uint8_t>>& bytes);
  bool Apart() const { return !options_.parameters.sharing; }
  bool Finished() const;
  // Server.
  void Arrive(int worker, const std::vector<Path>& paths);
  void TryBatch(bool waited);
  void EndBatch(std::vector<Path> paths);
  void Reply(Answers answers);
  // Bus.
  std::int64_t Later() {
    return events_.now_us() + options_.delay_us +
           std::uniform_int_distribution<std::int64_t>(0, options_.jitter_us)(random_);
  }
  bool Chance(double share) {
    return share > 0 && std::uniform_real_distribution<double>(0, 1)(random_) < share;
  }
  // Figures.
  void LookHowFresh();
  void Close();
  void SendToAll(Search* sender);
  bool AllExact() const;
  void ReadOff();

  BusOptions options_;
  ScriptedTree tree_;
  std::mt19937_64 random_;
  EventQueue events_;
  std::vector<Worker> workers_;
  std::deque<Path> queue_;
  std::unordered_map<Path, std::set<int>, planner::PathHash> asked_;  // queued or in the batch
  std::unordered_map<Path, planner::Evaluation, planner::PathHash> known_;
  bool computing_ = false;
  int due_back_ = 0;
  std::uint64_t waits_ = 0;
  double server_us_ = 0;
  double bus_bytes_ = 0;
  double fresh_sum_ = 0;
  int fresh_count_ = 0;
  BusResult result_;
};

SimulatedBus::SimulatedBus(const BusOptions& options)
    : options_(options), tree_{options.seed}, random_(options.seed * 7919 + 17) {
  planner::SearchParameters parameters = options.parameters;
  parameters.seed = options.seed;
  parameters.workers = options.workers;
  for (int i = 0; i < options.workers; ++i) {
    planner::SearchIdentity identity;
    identity.writer = static_cast<std::uint64_t>(i) + 1;
    identity.worker_index = i;
    Worker& worker = workers_.emplace_back();
    worker.search = std::make_unique<Search>(ScriptedTree::Rules(), parameters, Path{}, identity);
  }
}

BusResult SimulatedBus::Run() {
  for (int i = 0; i < options_.workers; ++i) {
    events_.At(std::uniform_int_distribution<std::int64_t>(0, 5000)(random_),
               [this, i] { Tick(i); });
  }
  if (options_.workers > 1 && options_.workers <= 16 && !Apart()) {
    events_.At(kFreshUs, [this] { LookHowFresh(); });
  }
  while (!Finished() && events_.now_us() < kLongestUs) events_.Next();
  result_.simulated_us = events_.now_us();
  const auto elapsed = static_cast<double>(std::max<std::int64_t>(1, result_.simulated_us));
  result_.server_busy = server_us_ / elapsed;
  for (const Worker& worker : workers_) {
    result_.worker_busy = std::max(result_.worker_busy, worker.busy_us / elapsed);
    result_.rollouts += worker.search->rollouts();
  }
  result_.bus_busy = bus_bytes_ / options_.bus_bytes_per_s / (elapsed * 1e-6);
  if (fresh_count_ > 0) result_.fresh = fresh_sum_ / fresh_count_;
  Close();
  ReadOff();
  return result_;
}

bool SimulatedBus::Finished() const {
  return std::all_of(workers_.begin(), workers_.end(), [this](const Worker& worker) {
    return worker.search->finished(events_.now_us());
  });
}

// --- workers

// Lets a worker do something that takes processor time, when its thread is free.
void SimulatedBus::Handle(int index, std::int64_t time_us, std::function<double(Search*)> work) {
  events_.At(time_us, [this, index, work = std::move(work)]() mutable {
    Worker& worker = workers_[index];
    if (worker.busy_until_us > events_.now_us()) {
      Handle(index, worker.busy_until_us, std::move(work));
      return;
    }
    const double us = work(worker.search.get());
    worker.busy_us += us;
    worker.busy_until_us = events_.now_us() + static_cast<std::int64_t>(us);
    Move(index);
  });
}

void SimulatedBus::Move(int index) {
  Worker& worker = workers_[index];
  Search& search = *worker.search;
  const std::int64_t before = search.rollouts();
  const int more = std::max(0, options_.leaves - search.waiting());
  const auto asked =
      std::make_shared<const std::vector<Path>>(search.Advance(more, events_.now_us()));
  const double us = options_.rollout_us * static_cast<double>(search.rollouts() - before + 1);
  worker.busy_us += us;
  worker.busy_until_us += static_cast<std::int64_t>(us);
  if (search.WantsExchange()) SendStatistics(index);
  if (asked->empty()) return;
  bus_bytes_ += kMessageBytes + kPathBytes * static_cast<double>(asked->size());
  events_.At(Later(), [this, index, asked] { Arrive(index, *asked); });
  if (Apart()) return;
  for (int other = 0; other < options_.workers; ++other) {
    if (other == index) continue;
    Handle(other, Later(), [this, index, asked](Search* heard) {
      heard->NoteRequested(*asked, events_.now_us(), static_cast<std::uint64_t>(index) + 1);
      return options_.message_us;
    });
  }
}

void SimulatedBus::Tick(int index) {
  SendStatistics(index);
  Move(index);
  events_.At(events_.now_us() + options_.tick_us, [this, index] { Tick(index); });
}

void SimulatedBus::SendStatistics(int index) {
  Search& search = *workers_[index].search;
  if (Apart()) return;
  const auto start = Clock::now();
  auto batch =
      std::make_shared<StatisticsBatch>(search.MakeBatch(options_.tick_bytes, events_.now_us()));
  auto bytes = std::make_shared<std::vector<std::uint8_t>>(planner::PackRows(*batch));
  result_.statistics_us += std::chrono::duration<double, std::micro>(Clock::now() - start).count();
  const double size = static_cast<double>(planner::kBatchHeaderBytes + bytes->size());
  if (!batch->totals.finished) result_.statistics_bytes += size;
  bus_bytes_ += size;
  for (int other = 0; other < options_.workers; ++other) {
    if (other == index || Chance(options_.drop)) continue;
    const int copies = Chance(options_.repeat) ? 2 : 1;
    for (int i = 0; i < copies; ++i) {
      Handle(other, Later(), [this, other, batch, bytes](Search*) {
        Receive(other, batch, bytes);
        return options_.message_us +
               options_.row_merge_us * static_cast<double>(batch->rows.size());
      });
    }
  }
}

// As in a worker's process: from bytes. With many workers that would only heat the room.
void SimulatedBus::Receive(int index, const std::shared_ptr<const StatisticsBatch>& batch,
                           const std::shared_ptr<const std::vector<std::uint8_t>>& bytes) {
  Search& search = *workers_[index].search;
  if (options_.workers > 16) {
    search.Merge(*batch, events_.now_us());
    return;
  }
  const auto start = Clock::now();
  StatisticsBatch heard = *batch;
  const bool read = planner::UnpackRows(*bytes, &heard);
  if (read) search.Merge(heard, events_.now_us());
  result_.statistics_us += std::chrono::duration<double, std::micro>(Clock::now() - start).count();
}

// --- server

void SimulatedBus::Arrive(int worker, const std::vector<Path>& paths) {
  auto at_once = std::make_shared<std::vector<Answer>>();
  for (const Path& path : paths) {
    const auto found = known_.find(path);
    if (found != known_.end()) {
      at_once->push_back({path, found->second, {worker}});
      continue;
    }
    std::set<int>& askers = asked_[path];
    if (askers.empty()) queue_.push_back(path);
    askers.insert(worker);
  }
  if (!at_once->empty()) Reply(at_once);
  TryBatch(false);
}

void SimulatedBus::TryBatch(bool waited) {
  if (computing_ || queue_.empty()) return;
  const int wanted = std::min(options_.max_batch, due_back_);
  if (!waited && static_cast<int>(queue_.size()) < wanted) return;
  due_back_ = 0;
  ++waits_;
  computing_ = true;
  const auto rows = std::min<std::ptrdiff_t>(options_.max_batch, queue_.size());
  std::vector<Path> paths(queue_.begin(), queue_.begin() + rows);
  queue_.erase(queue_.begin(), queue_.begin() + rows);
  const std::int64_t us = options_.fixed_us + options_.row_us * rows;
  server_us_ += static_cast<double>(us);
  events_.At(events_.now_us() + us, [this, paths] { EndBatch(paths); });
}

void SimulatedBus::EndBatch(std::vector<Path> paths) {
  auto answers = std::make_shared<std::vector<Answer>>();
  for (const Path& path : paths) {
    const planner::Evaluation evaluation = tree_.Evaluate(path);
    known_[path] = evaluation;
    answers->push_back({path, evaluation, asked_[path]});
    asked_.erase(path);
  }
  result_.evaluations += static_cast<std::int64_t>(paths.size());
  ++result_.batches;
  computing_ = false;
  due_back_ = static_cast<int>(paths.size() + queue_.size());  // those answered, and those here
  Reply(answers);
  const std::uint64_t wait = waits_;
  events_.At(events_.now_us() + options_.regroup_us, [this, wait] {
    if (wait == waits_) due_back_ = 0;
    TryBatch(true);
  });
  TryBatch(false);
}

void SimulatedBus::Reply(Answers answers) {
  bus_bytes_ += kMessageBytes + kAnswerBytes * static_cast<double>(answers->size());
  for (int i = 0; i < options_.workers; ++i) {
    Handle(i, Later(), [this, i, answers](Search* search) {
      for (const Answer& answer : *answers) {
        if (Apart() && !answer.askers.contains(i)) continue;
        search->Deliver(answer.path, answer.evaluation, 0);
      }
      return options_.message_us + options_.heard_us * static_cast<double>(answers->size());
    });
  }
}

// --- figures

// Remembers what visits there are in the top levels, and looks 100 ms later who knows of them.
void SimulatedBus::LookHowFresh() {
  auto truth = std::make_shared<std::map<Path, std::int64_t>>();
  for (const Worker& worker : workers_) {
    const planner::PathTree& paths = worker.search->paths();
    for (planner::PathId id = planner::kRoot + 1; id < paths.size(); ++id) {
      const std::int64_t visits = worker.search->statistics().own_visits(id);
      if (visits > 0 && paths.depth(id) <= kTopLevels) (*truth)[paths.PathOf(id)] += visits;
    }
  }
  events_.At(events_.now_us() + kFreshUs, [this, truth] {
    double there = 0, known = 0;
    for (const auto& [path, visits] : *truth) {
      std::int64_t least = visits;
      for (const Worker& worker : workers_) {
        const Search& search = *worker.search;
        least = std::min(least, search.statistics().totals(search.paths().Find(path)).visits);
      }
      there += static_cast<double>(visits);
      known += static_cast<double>(least);
    }
    if (there > 0) fresh_sum_ += known / there, ++fresh_count_;
    LookHowFresh();
  });
}

// What ends a search: at most two rounds of everybody's rows, over a bus that loses nothing.
// Batches that everybody knows already change nothing, so it is over when all tables are equal.
void SimulatedBus::Close() {
  if (Apart() || options_.workers > 16) return;
  std::vector<std::int64_t> rounds;
  for (const Worker& sender : workers_) {
    rounds.push_back(sender.search->statistics().round_robin_rounds());
  }
  for (bool more = true; more && !AllExact();) {
    more = false;
    for (std::size_t i = 0; i < workers_.size(); ++i) {
      if (workers_[i].search->statistics().round_robin_rounds() >= rounds[i] + 2) continue;
      SendToAll(workers_[i].search.get());
      more = true;
    }
  }
  result_.exact = AllExact();
}

void SimulatedBus::SendToAll(Search* sender) {
  const std::int64_t now_us = events_.now_us();
  const StatisticsBatch batch = sender->MakeBatch(options_.tick_bytes, now_us);
  for (Worker& receiver : workers_) receiver.search->Merge(batch, now_us);
}

// All tables are equal, and hold every rollout.
bool SimulatedBus::AllExact() const {
  const std::uint64_t digest = workers_.front().search->statistics().digest();
  return std::all_of(workers_.begin(), workers_.end(), [&](const Worker& worker) {
    const auto& statistics = worker.search->statistics();
    return statistics.digest() == digest &&
           statistics.totals(planner::kRoot).visits == result_.rollouts;
  });
}

// As the executive does, who only watches; any worker that shares knows as much.
void SimulatedBus::ReadOff() {
  planner::SearchIdentity watcher;
  watcher.writer = workers_.size() + 1;
  Search search(ScriptedTree::Rules(), options_.parameters, {}, watcher);
  for (Worker& worker : workers_) {
    search.Merge(worker.search->MakeBatch(kPlenty, events_.now_us()), events_.now_us());
  }
  for (const Path& path : search.MissingEvaluations(1 << 30)) {
    search.Deliver(path, tree_.Evaluate(path), 0);
  }
  const planner::Plan plan = search.BestPlan();
  const ScriptedTree::Optimum optimum = tree_.FindOptimum();
  result_.optimal = plan.ok() && plan.best.path == optimum.path;
  result_.regret = optimum.value - (plan.ok() ? tree_.Value(plan.best.path) : 0);
}

}  // namespace

std::string BusResult::Bottleneck() const {
  if (std::max({server_busy, worker_busy, bus_busy}) < 0.6) return "round trips";
  if (server_busy >= std::max(worker_busy, bus_busy)) return "model server";
  return worker_busy >= bus_busy ? "workers' processors" : "bus";
}

BusResult SimulateBus(const BusOptions& options) { return SimulatedBus(options).Run(); }

}  // namespace prospect::tools
