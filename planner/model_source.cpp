#include "planner/model_source.h"

#include <algorithm>
#include <stdexcept>

namespace prospect::planner {

std::vector<Evaluation> ModelSource::EvaluateBatch(const std::vector<Path>& paths) {
  std::vector<Evaluation> evaluations;
  evaluations.reserve(paths.size());
  for (const Path& path : paths) evaluations.push_back(Evaluate(path));
  return evaluations;
}

namespace {

void DeliverAll(Search* search, const std::vector<Path>& paths,
                const std::vector<Evaluation>& evaluations) {
  for (std::size_t i = 0; i < paths.size(); ++i) {
    if (search->Deliver(paths[i], evaluations.at(i), 0) != Delivery::kRefused) continue;
    throw std::runtime_error("the model's evaluation of " + ToString(paths[i]) +
                             " is unsound: " + Defect(evaluations[i], search->rules().num_actions));
  }
}

}  // namespace

void RunSearch(Search* search, ModelSource* model, int leaves) {
  constexpr std::int64_t kNow = 0;
  if (leaves < 1) throw std::invalid_argument("a search needs at least one leaf in flight");
  while (!search->finished(kNow)) {
    const std::int64_t rollouts = search->rollouts();
    const std::vector<Path> paths = search->Advance(std::max(0, leaves - search->waiting()), kNow);
    if (paths.empty() && search->rollouts() == rollouts && !search->finished(kNow)) {
      throw std::runtime_error(
          "this search waits for other workers: drive it with MakeBatch and Merge, not RunSearch");
    }
    DeliverAll(search, paths, model->EvaluateBatch(paths));
  }
}

}  // namespace prospect::planner
