#include <algorithm>

#include "lcmtypes/validate.h"
#include "lcmtypes/value_check.h"

namespace prospect::messages {
namespace {

using namespace internal;

constexpr int kMaxStatus = expand_reply_t::STATUS_REFUSED;

bool AreFinite(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(),
                     [](double value) { return std::isfinite(value); });
}

bool AreFinite(const std::vector<float>& values) {
  return std::all_of(values.begin(), values.end(),
                     [](float value) { return std::isfinite(value); });
}

bool IsAscending(const std::vector<std::uint8_t>& actions) {
  return std::adjacent_find(actions.begin(), actions.end(), std::greater_equal<>()) ==
         actions.end();
}

void CheckEvaluation(const evaluation_t& evaluation, ValueCheck& check) {
  check.That(IsPath(evaluation.path), "evaluations: bad path")
      .That(IsProbability(evaluation.value) && IsProbability(evaluation.done),
            "evaluations: no probability")
      .That(IsAscending(evaluation.actions), "evaluations: actions out of order");
}

bool AllWithin(const std::vector<std::uint8_t>& values, int low, int high) {
  return std::all_of(values.begin(), values.end(),
                     [&](int value) { return InRange(value, low, high); });
}

bool AreAscendingProbabilities(const std::vector<float>& values) {
  return std::is_sorted(values.begin(), values.end()) &&
         std::all_of(values.begin(), values.end(), [](float v) { return IsProbability(v); });
}

bool IsNovelty(const novelty_t& novelty) {
  const double distances[] = {novelty.error,          novelty.error_limit, novelty.residual,
                              novelty.residual_limit, novelty.state,       novelty.state_limit};
  return IsProbability(novelty.p) &&
         std::all_of(std::begin(distances), std::end(distances),
                     [](double value) { return std::isfinite(value) && value >= 0; });
}

}  // namespace

std::string Validate(const calibration_t& message) {
  ValueCheck check;
  check.That(IsProbability(message.refusal_threshold), "refusal_threshold: out of 0..1")
      .That(AreFinite(message.parameter_values), "parameter_values: not finite")
      .That(AreAscendingProbabilities(message.scores), "scores: not ascending within 0..1")
      .That(AllWithin(message.classes, message.CLASS_SOLVABLE, message.CLASS_DOUBTFUL),
            "classes: unknown")
      .That(AllWithin(message.endings, message.ENDING_SOLVED, message.ENDING_REFUSED),
            "endings: unknown");
  return check.Result();
}

std::string Validate(const expand_reply_t& message) {
  ValueCheck check;
  check.That(InRange<int>(message.status, 0, kMaxStatus), "status: unknown")
      .That(IsCount(message.retry_ms), "retry_ms: negative")
      .That(std::isfinite(message.wait_ms) && message.wait_ms >= 0, "wait_ms: negative");
  for (const evaluation_t& evaluation : message.evaluations) CheckEvaluation(evaluation, check);
  return check.Result();
}

std::string Validate(const expand_request_t& message) {
  ValueCheck check;
  check.That(IsCount(message.attempt), "attempt: negative")
      .That(InRange(message.num_paths, 1, kMaxPathsPerRequest), "num_paths: out of range")
      .That(IsBudget(message.budget_ms), "budget_ms: beyond ten years");
  for (const path_t& path : message.paths) check.That(IsPath(path), "paths: bad path");
  return check.Result();
}

std::string Validate(const model_info_t& message) {
  ValueCheck check;
  check.That(InRange(message.num_actions, 1, kMaxActions), "num_actions: out of range")
      .That(InRange(message.image_width, 1, kMaxImageSide) &&
                InRange(message.image_height, 1, kMaxImageSide),
            "image: out of range")
      .That(IsBoolean(message.judges), "judges: neither 0 nor 1")
      .That(IsProbability(message.refusal_threshold), "refusal_threshold: out of 0..1")
      .That(InRange(message.calibrations, 0, kMaxCalibrations), "calibrations: out of range")
      .That(IsCount(message.queue), "queue: negative")
      .That(std::isfinite(message.queue_age_ms) && std::isfinite(message.batch_ms),
            "batch_ms: not finite")
      .That(IsCount(message.evaluations) && IsCount(message.cache_hits), "evaluations: negative");
  for (const std::int64_t bin : message.batch_histogram)
    check.That(IsCount(bin), "batch_histogram: negative");
  check.That(IsCount(message.batches), "batches: negative")
      .That(std::isfinite(message.compute_seconds) && message.compute_seconds >= 0,
            "compute_seconds: negative");
  for (const auto* histogram : {&message.age_histogram, &message.latency_histogram})
    for (const std::int64_t bin : *histogram) check.That(IsCount(bin), "histogram: negative");
  return check.Result();
}

std::string Validate(const predict_reply_t& message) {
  const bool no_picture = message.width == 0 && message.height == 0 && message.num_bytes == 0;
  ValueCheck check;
  check.That(InRange<int>(message.status, 0, kMaxStatus), "status: unknown")
      .That(IsPath(message.path), "path: bad")
      .That(no_picture || IsPicture(message.width, message.height, message.num_bytes),
            "data: wrong picture size")
      .That(AreFinite(message.hidden), "hidden: not finite")
      .That(message.num_novelty <= 1, "novelty: more than one")
      .That(std::all_of(message.novelty.begin(), message.novelty.end(), IsNovelty),
            "novelty: out of range");
  return check.Result();
}

std::string Validate(const predict_request_t& message) {
  ValueCheck check;
  check.That(IsPath(message.path), "path: bad")
      .That(IsBoolean(message.want_image) && IsBoolean(message.want_hidden),
            "want: neither 0 nor 1");
  return check.Result();
}

std::string Validate(const search_image_t& message) {
  ValueCheck check;
  check.That(message.encoding == observation_t::ENCODING_RGB8, "encoding: unknown")
      .That(IsPicture(message.width, message.height, message.num_bytes),
            "data: wrong picture size");
  return check.Result();
}

std::string Validate(const search_root_t& message) {
  ValueCheck check;
  check.That(IsCount(message.epoch), "epoch: negative")
      .That(message.num_executed <= kMaxPathLength, "num_executed: too many")
      .That(InRange(message.plan_length, 1, kMaxPathLength), "plan_length: out of range")
      .That(std::isfinite(message.time_left), "time_left: not finite")
      .That(!message.rule.empty(), "rule: empty")
      .That(AreFinite(message.parameter_values), "parameter_values: not finite")
      .That(InRange(message.depth, 1, kMaxPathLength), "depth: out of range")
      .That(message.samples >= 1, "samples: below 1")
      .That(message.leaves >= 1, "leaves: below 1")
      .That(IsBudget(message.budget_ms), "budget_ms: beyond ten years")
      .That(IsBoolean(message.sharing), "sharing: neither 0 nor 1");
  return check.Result();
}

std::string Validate(const search_statistics_t& message) {
  ValueCheck check;
  check.That(IsCount(message.sequence), "sequence: negative")
      .That(IsCount(message.lease_ms), "lease_ms: negative")
      .That(IsCount(message.rollouts) && IsCount(message.evaluations) &&
                IsCount(message.in_flight) && IsCount(message.row_count) &&
                IsCount(message.claimed) && IsCount(message.round),
            "totals: negative")
      .That(IsBoolean(message.is_final), "is_final: neither 0 nor 1");
  return check.Result();
}

std::string Validate(const search_stop_t& message) {
  ValueCheck check;
  check.That(IsCount(message.epoch), "epoch: negative");
  return check.Result();
}

}  // namespace prospect::messages
