#include "tools/evaluate/open_loop.h"

#include <utility>

namespace prospect::tools {
namespace {

class OpenLoop : public Decider {
 public:
  explicit OpenLoop(std::unique_ptr<Decider> inner) : inner_(std::move(inner)) {}

  void Begin(std::uint64_t scene_seed, const std::vector<std::uint8_t>& first) override {
    plan_.clear();
    inner_->Begin(scene_seed, first);
  }

  Decision Decide(const planner::Path& executed, const std::vector<std::uint8_t>& latest,
                  sim::Task& task) override {
    if (!plan_.empty()) return Follow(executed.size());
    Decision decision = inner_->Decide(executed, latest, task);
    if (decision.action >= 0) plan_ = decision.plan;
    score_ = decision.score;
    return decision;
  }

 private:
  Decision Follow(std::size_t done) const {
    Decision decision;
    decision.score = score_;
    if (done < plan_.size()) {
      decision.action = plan_[done];
    } else {
      decision.reason = "the plan was carried out and the task is not complete";
    }
    return decision;
  }

  std::unique_ptr<Decider> inner_;
  planner::Path plan_;
  double score_ = 0;
};

}  // namespace

std::unique_ptr<Decider> MakeOpenLoop(std::unique_ptr<Decider> inner) {
  return std::make_unique<OpenLoop>(std::move(inner));
}

}  // namespace prospect::tools
