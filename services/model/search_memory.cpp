#include "services/model/search_memory.h"

#include <algorithm>
#include <stdexcept>
#include <unordered_set>
#include <utility>

#include "services/binding/evaluation_messages.h"

namespace prospect::services {

using planner::Path;

SearchMemory::SearchMemory(model::Engine& engine, planner::TaskRules rules, Path executed,
                           std::size_t cache_bytes)
    : engine_(engine),
      rules_(std::move(rules)),
      executed_(std::move(executed)),
      cache_bytes_(cache_bytes) {}

void SearchMemory::SetRoot(model::Hidden first, model::Hidden present) {
  first_ = std::move(first);
  present_ = std::move(present);
}

SearchMemory::SharedHidden SearchMemory::Find(const Path& path) {
  const auto pinned = pinned_.find(path);
  if (pinned != pinned_.end()) return pinned->second;
  const auto kept = kept_.find(path);
  if (kept == kept_.end()) return nullptr;
  uses_.splice(uses_.begin(), uses_, kept->second.use);
  return pinned_[path] = kept->second.hidden;
}

void SearchMemory::Keep(const Path& path, SharedHidden hidden) {
  pinned_[path] = hidden;
  if (kept_.count(path)) return;
  hidden_bytes_ += hidden->size() * sizeof(float);
  uses_.push_front(path);
  kept_[path] = {std::move(hidden), uses_.begin()};
  Evict();
}

void SearchMemory::Evict() {
  while (hidden_bytes_ > cache_bytes_ && !uses_.empty()) {
    const auto oldest = kept_.find(uses_.back());
    hidden_bytes_ -= oldest->second.hidden->size() * sizeof(float);
    kept_.erase(oldest);
    uses_.pop_back();
  }
}

void SearchMemory::Store(const Path& path, model::Prediction prediction) {
  planner::Evaluation evaluation;
  evaluation.value = prediction.value;
  evaluation.done = prediction.done;
  evaluation.q = std::move(prediction.q);
  evaluation.p = std::move(prediction.p);
  const std::string defect = planner::Defect(evaluation, rules_.num_actions);
  if (!defect.empty()) {
    throw std::runtime_error("the engine's answer for " + planner::ToString(path) +
                             " is unsound: " + defect);
  }
  evaluations_.emplace(path, ToMessage(path, evaluation, rules_.AllowedActions(executed_, path)));
  if (!prediction.h.empty())
    Keep(path, std::make_shared<const model::Hidden>(std::move(prediction.h)));
}

// Prefixes of `paths` that must be computed, shortest first: those without a state where a longer
// one needs it, and the paths themselves where they have no evaluation (or, with `states_too`, no
// state).
std::vector<SearchMemory::PathSet> SearchMemory::MissingByLength(const std::vector<Path>& paths,
                                                                 bool states_too) {
  std::vector<PathSet> missing;
  std::unordered_set<Path, planner::PathHash> seen;
  const auto add = [&](const Path& path) {
    if (!seen.insert(path).second) return false;
    if (missing.size() <= path.size()) missing.resize(path.size() + 1);
    missing[path.size()].push_back(path);
    return true;
  };
  for (const Path& path : paths) {
    const bool done = Knows(path) && (!states_too || path.empty() || Find(path));
    if (done || !add(path)) continue;
    for (Path prefix = path; prefix.size() > 1;) {
      prefix.pop_back();
      if (Find(prefix) || !add(prefix)) break;
    }
  }
  return missing;
}

void SearchMemory::ComputeRoot() {
  const int previous = executed_.empty() ? rules_.num_actions : executed_.back();
  Store({}, engine_.Evaluate(first_.data(), present_.data(), previous));
}

void SearchMemory::ComputeRows(const PathSet& paths, std::size_t begin, std::size_t end) {
  std::vector<model::ExpandInput> inputs;
  for (std::size_t i = begin; i < end; ++i) {
    const Path parent(paths[i].begin(), paths[i].end() - 1);
    const float* state = parent.empty() ? present_.data() : Find(parent)->data();
    inputs.push_back({first_.data(), state, paths[i].back()});
  }
  auto predictions = engine_.Expand(inputs);
  for (std::size_t i = begin; i < end; ++i) Store(paths[i], std::move(predictions[i - begin]));
}

int SearchMemory::ComputeMissing(const std::vector<Path>& paths, bool states_too, int batch) {
  if (!ready()) throw std::logic_error("the root's pictures have not been encoded yet");
  int rows = 0;
  const auto step = static_cast<std::size_t>(std::max(1, batch));
  for (const PathSet& level : MissingByLength(paths, states_too)) {
    rows += static_cast<int>(level.size());
    if (!level.empty() && level.front().empty()) {
      ComputeRoot();
      continue;
    }
    for (std::size_t i = 0; i < level.size(); i += step)
      ComputeRows(level, i, std::min(level.size(), i + step));
  }
  return rows;
}

int SearchMemory::Compute(const std::vector<Path>& paths, int batch) {
  const int rows = ComputeMissing(paths, false, batch);
  pinned_.clear();
  return rows;
}

model::Hidden SearchMemory::State(const Path& path) {
  if (path.empty()) return present_;
  ComputeMissing({path}, true, 1);
  model::Hidden state = *Find(path);
  pinned_.clear();
  return state;
}

}  // namespace prospect::services
