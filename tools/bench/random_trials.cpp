#include "tools/bench/random_trials.h"

#include <cstdio>
#include <vector>

#include "base/hash.h"
#include "base/random.h"
#include "model/dataset.h"

namespace prospect::tools {
namespace {

constexpr int kSegmentFrames = 6;  // enough that frames inside lie 0.3 s before the end

// Actions after which nothing may follow come only last.
std::vector<int> RandomActions(const sim::TaskSpec& spec, int count, base::Random* random) {
  std::vector<int> actions;
  int last = spec.null_action();
  for (int k = 0; k < count; ++k) {
    std::vector<int> onward;
    for (const int next : spec.successors[static_cast<std::size_t>(last)]) {
      const bool ends = spec.successors[static_cast<std::size_t>(next)].empty();
      if (!spec.IsRetry(last, next) && (!ends || k + 1 == count)) onward.push_back(next);
    }
    last = onward.at(static_cast<std::size_t>(random->Below(static_cast<int>(onward.size()))));
    actions.push_back(last);
  }
  return actions;
}

void AddFrame(int segment, const std::vector<int>& actions, model::Trial* trial) {
  const auto action = [&](int s) {
    return s < 0 ? trial->null_action() : actions[static_cast<std::size_t>(s)];
  };
  trial->segment.push_back(segment);
  trial->actions.push_back(action(segment));
  trial->prev_action.push_back(action(segment - 1));
  trial->rewards.push_back(0.0F);
  trial->dones.push_back(0);
}

void Describe(const sim::TaskSpec& spec, model::Trial* trial) {
  trial->task = spec.name;
  trial->world_version = spec.world_version;
  trial->task_hash = base::HexText(spec.Hash());
  trial->tick_seconds = spec.tick_seconds;
  trial->width = spec.image_width;
  trial->height = spec.image_height;
  trial->num_actions = static_cast<int>(spec.actions.size());
  trial->num_landmarks = static_cast<int>(spec.landmarks.size());
  trial->successors = spec.successors;
  trial->plan_length = spec.plan_length;
  trial->present.assign(spec.actions.size(), 1);
}

}  // namespace

model::Trial RandomTrial(const sim::TaskSpec& spec, std::uint64_t seed) {
  base::Random random(seed);
  model::Trial trial;
  trial.seed = seed;
  Describe(spec, &trial);
  const bool fails = seed % 2 == 1;
  const int segments = fails ? 1 + random.Below(spec.plan_length) : spec.plan_length;
  const std::vector<int> actions = RandomActions(spec, segments, &random);
  AddFrame(-1, actions, &trial);
  for (int i = 0; i < segments * kSegmentFrames; ++i) AddFrame(i / kSegmentFrames, actions, &trial);
  trial.outcome = fails ? "failure" : "success";
  trial.reason = fails ? "made" : "";
  trial.rewards.back() = fails ? -100.0F : 100.0F;
  trial.dones.back() = 1;
  trial.segment_succeeded.assign(static_cast<std::size_t>(segments), 1);
  if (fails) trial.segment_succeeded.back() = 0;
  trial.images.resize(static_cast<std::size_t>(trial.frames()) * trial.frame_bytes());
  for (std::uint8_t& byte : trial.images) byte = static_cast<std::uint8_t>(random.Below(256));
  trial.landmarks.resize(trial.actions.size() * spec.landmarks.size() * 2);
  for (float& x : trial.landmarks) x = static_cast<float>(random.Uniform());
  return trial;
}

void WriteRandomTrials(const sim::TaskSpec& spec, int trials, const std::string& path) {
  std::vector<std::string> parts;
  for (std::uint64_t seed = 0; static_cast<int>(parts.size()) < trials; ++seed) {
    if (model::SplitOf(seed) != model::Split::kTrain) continue;
    parts.push_back(path + "." + std::to_string(seed));
    model::WriteTrialFile(parts.back(), RandomTrial(spec, seed));
  }
  model::PackTrialFiles(parts, path);
  for (const std::string& part : parts) std::remove(part.c_str());
}

}  // namespace prospect::tools
