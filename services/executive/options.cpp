#include "services/executive/options.h"

namespace prospect::services {
namespace {

constexpr int kBlocksPerLevel = 9;  // actions by which a tower of stacking grows by a block

}  // namespace

void Take(const cli::EpisodeOptions& asked, ExecutiveOptions* taker) {
  ExecutiveOptions& options = *taker;
  options.task = asked.task;
  options.seed = asked.seed;
  options.objects = asked.scene.objects;
  options.legs =
      asked.scene.tower > 0 ? kBlocksPerLevel * (asked.scene.tower - 1) : asked.scene.legs;
  options.goal = asked.goal;
  options.search.samples = asked.samples;
  options.search.depth = asked.depth;
  options.search.rule = asked.rule;
  if (!asked.rule.empty()) options.search.UseRule(asked.rule);
  options.workers = asked.workers > 0 ? asked.workers : 1;
  options.refusal_threshold = asked.refusal.threshold.value_or(-1);
  options.promise.refuse_at_most = asked.refusal.promise.refuse_at_most;
  options.promise.fail_at_most = asked.refusal.promise.fail_at_most;
  options.promise.delta = asked.refusal.promise.delta;
  options.novelty = asked.refusal.novelty;
  options.out = asked.out;
}

}  // namespace prospect::services
