#include "model/training/train_config.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "model/json_fields.h"

namespace prospect::model {
namespace {

void Require(bool holds, const std::string& what) {
  if (!holds) throw std::invalid_argument(what);
}

constexpr std::int64_t kMostIterations = 1'000'000'000;
constexpr double kMostWeight = 1e6;  // beside which nothing else in a loss would count

/// Not true of what is no number, either.
void RequireWeight(double weight, const std::string& name) {
  Require(weight >= 0 && weight <= kMostWeight, name + ": must be 0 to 1,000,000");
}

/// Whether this processor has AVX512-BF16, as those with AMX do, too.
bool MultipliesBfloat() {
#if defined(__x86_64__)
  return __builtin_cpu_supports("avx512bf16") != 0;
#else
  return false;
#endif
}

void ValidateStage(const StageConfig& stage, const std::string& name) {
  Require(stage.iterations >= 0 && stage.iterations <= kMostIterations,
          name + ".iterations: must be 0 to 1,000,000,000");
  Require(stage.batch >= 1 && stage.batch <= 4096, name + ".batch: must be 1 to 4096");
  Require(stage.learning_rate > 0 && stage.learning_rate < 1,
          name + ".learning_rate: must be above 0, below 1");
}

}  // namespace

void ScaleIterations(std::int64_t transform_iterations, TrainConfig* config) {
  const std::int64_t now = config->transform_hidden.iterations + config->transform_image.iterations;
  Require(now > 0 && transform_iterations > 0 && transform_iterations <= kMostIterations,
          "iterations: must be 1 to 1,000,000,000");
  for (StageConfig* stage : {&config->classifier, &config->encoder_decoder,
                             &config->transform_hidden, &config->transform_image, &config->heads}) {
    const std::int64_t scaled = stage->iterations * transform_iterations / now;
    stage->iterations = stage->iterations > 0 ? std::max<std::int64_t>(1, scaled) : 0;
  }
}

TrainConfig Resolved(TrainConfig config, const std::string& device) {
  if (config.precision != "auto") return config;
  config.precision = device == "cpu" && MultipliesBfloat() ? "mixed" : "float32";
  return config;
}

void Validate(const TrainConfig& c) {
  Validate(c.network);
  Require(c.shards >= 1 && c.shards <= 64, "shards: must be 1 to 64");
  Require(c.precision == "float32" || c.precision == "mixed" || c.precision == "auto",
          "precision: must be float32, mixed or auto");
  Require(c.mids_per_segment >= 0 && c.mids_per_segment <= 100,
          "mids_per_segment: must be 0 to 100");
  Require(c.augment == "none" || c.augment == "dihedral" || c.augment == "camera",
          "augment: must be none, dihedral or camera");
  Require(c.augment != "camera" || c.landmark_weight == 0,
          "augment: camera moves pictures, not their landmarks: set landmark_weight to 0");
  Require(c.augment != "dihedral" || c.network.image_width == c.network.image_height,
          "augment: dihedral needs square pictures");
  Require(c.hidden_variants >= 1 && c.hidden_variants <= (c.augment == "none" ? 1 : 8),
          "hidden_variants: must be 1, or up to 8 with an augment");
  RequireWeight(c.focus, "focus");
  RequireWeight(c.gain_weight, "gain_weight");
  RequireWeight(c.landmark_weight, "landmark_weight");
  Require(c.linked_steps >= 1 && c.linked_steps <= 9, "linked_steps: must be 1 to 9");
  Require(c.linked_from >= 0 && c.linked_from <= c.linked_steps,
          "linked_from: must be 0 to linked_steps");
  RequireWeight(c.lambda, "lambda");
  RequireWeight(c.picture_weight, "picture_weight");
  Require(c.adversary == "none" || c.adversary == "pix2pix" || c.adversary == "wgan",
          "adversary: must be none, pix2pix or wgan");
  Require(c.adversary == "none" || c.linked_steps >= 2,
          "adversary: needs linked_steps of 2 at least");
  Require(c.judge_steps >= 1 && c.judge_steps <= 1000, "judge_steps: must be 1 to 1000");
  Require(c.judge_clip > 0 && c.judge_clip <= kMostWeight && c.judge_rate > 0 &&
              c.judge_rate <= kMostWeight,
          "judge_clip, judge_rate: must be above 0, at most 1,000,000");
  Require(c.start_share >= 0 && c.start_share <= 1, "start_share: must be 0 to 1");
  Require(c.imagined_share >= 0 && c.imagined_share <= 1, "imagined_share: must be 0 to 1");
  RequireWeight(c.inside_weight, "inside_weight");
  RequireWeight(c.done_weight, "done_weight");
  RequireWeight(c.checkpoint_seconds, "checkpoint_seconds");
  Require(c.labels == "paper" || c.labels == "authors", "labels: must be paper or authors");
  ValidateStage(c.classifier, "classifier");
  ValidateStage(c.encoder_decoder, "encoder_decoder");
  ValidateStage(c.transform_hidden, "transform_hidden");
  ValidateStage(c.transform_image, "transform_image");
  ValidateStage(c.heads, "heads");
}

void to_json(nlohmann::json& json, const StageConfig& c) {
  json = {{"iterations", c.iterations}, {"batch", c.batch}, {"learning_rate", c.learning_rate}};
}

void from_json(const nlohmann::json& json, StageConfig& c) {
  JsonFields(json, "stage")
      .Read("iterations", &c.iterations)
      .Read("batch", &c.batch)
      .Read("learning_rate", &c.learning_rate)
      .RefuseOthers();
}

void to_json(nlohmann::json& json, const TrainConfig& c) {
  json = {{"network", c.network},
          {"seed", c.seed},
          {"shards", c.shards},
          {"checkpoint_seconds", c.checkpoint_seconds},
          {"precision", c.precision},
          {"mids_per_segment", c.mids_per_segment},
          {"augment", c.augment},
          {"hidden_variants", c.hidden_variants},
          {"focus", c.focus},
          {"landmark_weight", c.landmark_weight},
          {"gain_weight", c.gain_weight},
          {"classifier", c.classifier},
          {"encoder_decoder", c.encoder_decoder},
          {"transform_hidden", c.transform_hidden},
          {"transform_image", c.transform_image},
          {"heads", c.heads},
          {"heads_need_failures", c.heads_need_failures},
          {"lambda", c.lambda},
          {"linked_steps", c.linked_steps},
          {"linked_from", c.linked_from},
          {"repeat_last", c.repeat_last},
          {"picture_weight", c.picture_weight},
          {"adversary", c.adversary},
          {"finetune", c.finetune},
          {"judge_steps", c.judge_steps},
          {"judge_clip", c.judge_clip},
          {"judge_rate", c.judge_rate},
          {"start_share", c.start_share},
          {"done_weight", c.done_weight},
          {"imagined_share", c.imagined_share},
          {"inside_weight", c.inside_weight},
          {"compose", c.compose},
          {"labels", c.labels}};
}

void from_json(const nlohmann::json& json, TrainConfig& c) {
  JsonFields(json, "config")
      .Read("network", &c.network)
      .Read("seed", &c.seed)
      .Read("shards", &c.shards)
      .Read("checkpoint_seconds", &c.checkpoint_seconds)
      .Read("precision", &c.precision)
      .Read("mids_per_segment", &c.mids_per_segment)
      .Read("augment", &c.augment)
      .Read("hidden_variants", &c.hidden_variants)
      .Read("focus", &c.focus)
      .Read("landmark_weight", &c.landmark_weight)
      .Read("gain_weight", &c.gain_weight)
      .Read("classifier", &c.classifier)
      .Read("encoder_decoder", &c.encoder_decoder)
      .Read("transform_hidden", &c.transform_hidden)
      .Read("transform_image", &c.transform_image)
      .Read("heads", &c.heads)
      .Read("heads_need_failures", &c.heads_need_failures)
      .Read("lambda", &c.lambda)
      .Read("linked_steps", &c.linked_steps)
      .Read("linked_from", &c.linked_from)
      .Read("repeat_last", &c.repeat_last)
      .Read("picture_weight", &c.picture_weight)
      .Read("adversary", &c.adversary)
      .Read("finetune", &c.finetune)
      .Read("judge_steps", &c.judge_steps)
      .Read("judge_clip", &c.judge_clip)
      .Read("judge_rate", &c.judge_rate)
      .Read("start_share", &c.start_share)
      .Read("done_weight", &c.done_weight)
      .Read("imagined_share", &c.imagined_share)
      .Read("inside_weight", &c.inside_weight)
      .Read("compose", &c.compose)
      .Read("labels", &c.labels)
      .RefuseOthers();
  Validate(c);
}

}  // namespace prospect::model
