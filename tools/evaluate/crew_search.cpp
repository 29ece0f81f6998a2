#include "tools/evaluate/crew_search.h"

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <vector>

namespace prospect::tools {
namespace {

using planner::Path;
using planner::Search;

constexpr std::int64_t kTurnUs = 4000;
constexpr std::size_t kTickBytes = 60000;
// Far beyond any search's need: a search that never ends is a fault, and is told.
constexpr std::int64_t kMostTurns = 10'000'000;

class Crew {
 public:
  Crew(const planner::TaskRules& rules, const planner::SearchParameters& parameters,
       const Path& executed, planner::ModelSource* model)
      : model_(model) {
    for (int i = 0; i < parameters.workers; ++i) {
      planner::SearchIdentity identity;
      identity.writer = static_cast<std::uint64_t>(i) + 1;
      identity.worker_index = i;
      workers_.push_back(std::make_unique<Search>(rules, parameters, executed, identity));
    }
  }

  CrewResult Run(int turns_per_tick) {
    Exchange();
    for (std::int64_t turn = 1; !Finished(); ++turn) {
      if (turn > kMostTurns) throw std::runtime_error("the workers' search does not end");
      now_us_ += kTurnUs;
      Evaluate(Ask());
      if (turn % turns_per_tick == 0 || AnyWantsExchange()) Exchange();
    }
    Exchange();
    const Search& first = *workers_.front();
    return {first.BestPlan(), first.total_rollouts(), first.known_evaluations()};
  }

 private:
  bool Finished() const {
    return std::all_of(workers_.begin(), workers_.end(),
                       [this](const auto& search) { return search->finished(now_us_); });
  }

  bool AnyWantsExchange() const {
    return std::any_of(workers_.begin(), workers_.end(),
                       [](const auto& search) { return search->WantsExchange(); });
  }

  std::vector<Path> Ask() {
    std::vector<Path> asked;
    for (auto& search : workers_) {
      const auto paths = search->Advance(search->waiting() > 0 ? 0 : 1, now_us_);
      for (auto& other : workers_) {
        if (other != search) {
          other->NoteRequested(paths, now_us_, search->statistics().writer());
        }
      }
      asked.insert(asked.end(), paths.begin(), paths.end());
    }
    return asked;
  }

  void Evaluate(const std::vector<Path>& asked) {
    const auto answers = model_->EvaluateBatch(asked);
    for (std::size_t i = 0; i < asked.size(); ++i) {
      for (auto& search : workers_) search->Deliver(asked[i], answers[i], 0);
    }
  }

  void Exchange() {
    for (auto& search : workers_) {
      const auto batch = search->MakeBatch(kTickBytes, now_us_);
      for (auto& other : workers_) {
        if (other != search) other->Merge(batch, now_us_);
      }
    }
  }

  planner::ModelSource* model_;
  std::vector<std::unique_ptr<Search>> workers_;
  std::int64_t now_us_ = 0;
};

}  // namespace

CrewResult SearchWithCrew(const planner::TaskRules& rules,
                          const planner::SearchParameters& parameters, const Path& executed,
                          planner::ModelSource* model, int turns_per_tick) {
  return Crew(rules, parameters, executed, model).Run(turns_per_tick);
}

}  // namespace prospect::tools
