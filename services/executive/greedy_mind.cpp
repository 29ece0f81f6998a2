#include "services/executive/greedy_mind.h"

#include "planner/baseline_plans.h"
#include "planner/model_source.h"

namespace prospect::services {
namespace {

class Asked : public planner::ModelSource {
 public:
  explicit Asked(agent::Mind& mind) : mind_(mind) {}
  planner::Evaluation Evaluate(const planner::Path& path) override {
    return mind_.Judge({path}).at(path);
  }

 private:
  agent::Mind& mind_;
};

}  // namespace

// One rollout hands the pictures out, so that the servers can be asked about what follows them.
agent::SearchAnswer GreedyMind::Search(const agent::SearchQuestion& question) {
  agent::SearchQuestion once = question;
  once.parameters.samples = 1;
  agent::SearchAnswer answer = BusMind::Search(once);
  Asked model(*this);
  answer.plan = planner::PlanOf(
      planner::GreedyPlan(question.rules, question.parameters, question.executed, &model),
      "nothing is permitted");
  return answer;
}

}  // namespace prospect::services
