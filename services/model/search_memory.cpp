#include "services/model/search_memory.h"

#include <algorithm>
#include <stdexcept>
#include <unordered_map>
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
  if (kept_.contains(path)) return;
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

// Paths that must be computed for `paths`, in waves: a wave needs no state but those held and those
// of the waves before it. Paths of any length whose parents' states are held share the first wave,
// and so a batch. Missing are the paths themselves where they have no evaluation (or, with
// `states_too`, no state), and prefixes without a state where a longer path needs it.
std::vector<SearchMemory::PathSet> SearchMemory::MissingInWaves(const std::vector<Path>& paths,
                                                                bool states_too) {
  std::vector<PathSet> waves;
  std::unordered_map<Path, std::size_t, planner::PathHash> wave_of;
  const auto add = [&](const Path& path, std::size_t wave) {
    if (waves.size() <= wave) waves.resize(wave + 1);
    waves[wave].push_back(path);
    wave_of[path] = wave;
  };
  for (const Path& path : paths) {
    const bool done = Knows(path) && (!states_too || path.empty() || Find(path));
    if (done || wave_of.contains(path)) continue;
    // Back to the nearest prefix whose state is there or will be, then forth again.
    std::size_t length = path.size();
    std::size_t wave = 0;
    while (length > 1) {
      const Path parent(path.begin(), path.begin() + static_cast<std::ptrdiff_t>(length) - 1);
      const auto coming = wave_of.find(parent);
      if (coming != wave_of.end()) wave = coming->second + 1;
      if (coming != wave_of.end() || Find(parent)) break;
      --length;
    }
    for (; length < path.size(); ++length, ++wave)
      add(Path(path.begin(), path.begin() + static_cast<std::ptrdiff_t>(length)), wave);
    add(path, wave);
  }
  return waves;
}

void SearchMemory::ComputeRoot() {
  const int previous = executed_.empty() ? rules_.num_actions : executed_.back();
  Store({}, engine_.Evaluate(first_, present_, previous));
}

void SearchMemory::ComputeRows(const PathSet& paths, std::size_t begin, std::size_t end) {
  std::vector<model::ExpandInput> inputs;
  for (std::size_t i = begin; i < end; ++i) {
    const Path parent(paths[i].begin(), paths[i].end() - 1);
    const model::Hidden& state = parent.empty() ? present_ : *Find(parent);  // pinned
    inputs.push_back({first_, state, paths[i].back()});
  }
  auto predictions = engine_.Expand(inputs);
  for (std::size_t i = begin; i < end; ++i) Store(paths[i], std::move(predictions[i - begin]));
}

int SearchMemory::ComputeMissing(const std::vector<Path>& paths, bool states_too, int batch) {
  if (!ready()) throw std::logic_error("the root's pictures have not been encoded yet");
  int rows = 0;
  const auto step = static_cast<std::size_t>(std::max(1, batch));
  for (PathSet& wave : MissingInWaves(paths, states_too)) {
    rows += static_cast<int>(wave.size());
    const auto root = std::find(wave.begin(), wave.end(), Path());
    if (root != wave.end()) {
      ComputeRoot();
      wave.erase(root);
    }
    for (std::size_t i = 0; i < wave.size(); i += step)
      ComputeRows(wave, i, std::min(wave.size(), i + step));
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
