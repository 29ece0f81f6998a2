#include "tools/bench/simulated_bus.h"

#include <algorithm>
#include <deque>
#include <memory>
#include <vector>

#include "planner/scripted_model.h"
#include "planner/search.h"

namespace prospect::tools {
namespace {

using planner::Path;
using planner::Search;

class SimulatedBus {
 public:
  explicit SimulatedBus(const BusOptions& options);
  BusResult Run();

 private:
  void LetWorkersMove();
  void Exchange();
  void ServeOneBatch();
  bool Finished() const;

  BusOptions options_;
  planner::ScriptedModel model_;
  std::vector<std::unique_ptr<Search>> searches_;
  std::deque<Path> queue_;
  std::int64_t now_us_ = 0;
  std::int64_t next_tick_us_ = 0;
  BusResult result_;
};

planner::ScriptedModelParameters ModelOf(const BusOptions& options) {
  planner::ScriptedModelParameters parameters;
  parameters.num_actions = options.rules.num_actions;
  parameters.seed = options.seed;
  return parameters;
}

SimulatedBus::SimulatedBus(const BusOptions& options)
    : options_(options), model_(ModelOf(options)) {
  planner::SearchParameters parameters = options.parameters;
  parameters.seed = options.seed;
  for (int i = 0; i < options.workers; ++i) {
    planner::SearchIdentity identity;
    identity.writer = static_cast<std::uint64_t>(i) + 1;
    identity.worker_index = i;
    searches_.push_back(std::make_unique<Search>(options.rules, parameters, Path{}, identity));
  }
}

BusResult SimulatedBus::Run() {
  while (!Finished()) {
    LetWorkersMove();
    if (now_us_ >= next_tick_us_) Exchange();
    if (queue_.empty()) {
      now_us_ = std::max(now_us_, next_tick_us_);
    } else {
      ServeOneBatch();
    }
  }
  Exchange();
  const planner::Plan plan = searches_.front()->BestPlan();
  result_.score = plan.ok() ? plan.best.score : 0;
  result_.rollouts = searches_.front()->total_rollouts();
  result_.simulated_us = now_us_;
  return result_;
}

bool SimulatedBus::Finished() const {
  return std::all_of(searches_.begin(), searches_.end(),
                     [this](const auto& search) { return search->finished(now_us_); });
}

void SimulatedBus::LetWorkersMove() {
  for (auto& search : searches_) {
    const int more = std::max(0, options_.leaves - search->waiting());
    const std::vector<Path> asked = search->Advance(more, now_us_);
    for (auto& other : searches_) {
      if (other != search) other->NoteRequested(asked, now_us_);
    }
    queue_.insert(queue_.end(), asked.begin(), asked.end());
  }
}

void SimulatedBus::Exchange() {
  next_tick_us_ = now_us_ + options_.tick_us;
  for (auto& search : searches_) {
    const planner::StatisticsBatch batch = search->MakeBatch(options_.tick_bytes, now_us_);
    for (auto& other : searches_) other->Merge(batch, now_us_);
  }
}

void SimulatedBus::ServeOneBatch() {
  const int rows = std::min(options_.max_batch, static_cast<int>(queue_.size()));
  now_us_ += options_.fixed_us + options_.row_us * rows;
  for (int i = 0; i < rows; ++i) {
    const planner::Evaluation evaluation = model_.Evaluate(queue_.front());
    for (auto& search : searches_) search->Deliver(queue_.front(), evaluation, 0);
    queue_.pop_front();
  }
  result_.evaluations += rows;
  ++result_.batches;
}

}  // namespace

BusResult SimulateBus(const BusOptions& options) { return SimulatedBus(options).Run(); }

}  // namespace prospect::tools
