#include "tools/evaluate/local_mind.h"

#include <utility>

#include "agent/phase_clock.h"
#include "base/seconds_since.h"
#include "planner/model_source.h"
#include "planner/search.h"
#include "tools/evaluate/crew_search.h"

namespace prospect::tools {

void LocalMind::Recognise(model::Engine* engine, const model::NoveltyGauge& gauge) {
  engine_ = engine;
  gauge_ = gauge;
}

agent::SearchAnswer LocalMind::Search(const agent::SearchQuestion& question) {
  const auto since = agent::PhaseClock::Now();
  present_ = question.present.picture.rgb;
  agent::SearchAnswer answer = Find(question);
  answer.seconds = base::SecondsSince(since);
  return answer;
}

agent::Recognition LocalMind::Familiar() {
  agent::Recognition recognition;
  if (gauge_) recognition.novelty = gauge_->Judge(model::TakeNoveltySample(*engine_, present_));
  return recognition;
}

agent::SearchAnswer SearchWith(const agent::SearchQuestion& question, planner::ModelSource* model) {
  agent::SearchAnswer answer;
  if (question.parameters.workers > 1) {
    CrewResult crew = SearchWithCrew(question.rules, question.parameters, question.executed, model);
    answer.plan = std::move(crew.plan);
    answer.rollouts = crew.rollouts;
    answer.evaluations = crew.evaluations;
    answer.workers = question.parameters.workers;
    return answer;
  }
  planner::Search search(question.rules, question.parameters, question.executed,
                         planner::SearchIdentity{});
  planner::RunSearch(&search, model, 1);
  answer.plan = search.BestPlan();
  answer.rollouts = search.rollouts();
  answer.evaluations = search.known_evaluations();
  return answer;
}

}  // namespace prospect::tools
