#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "model/network_config.h"

namespace prospect::model {

/// How long and how fast one stage trains. Learning rates rise over the first 100 iterations and
/// fall to a hundredth along a cosine.
struct StageConfig {
  std::int64_t iterations = 1000;
  int batch = 32;
  double learning_rate = 1e-3;
};

/// Everything training depends on besides the data. Stored with the weights. A plain value.
///
/// The defaults follow the paper and, where it is silent, the authors' code, except for iterations,
/// batch and learning rate, which fit two CPU cores. Options that go beyond the paper say so here;
/// task files (docs/task-files.md) name those that a task turns on.
struct TrainConfig {
  NetworkConfig network;
  std::uint64_t seed = 1;
  /// A batch is cut into so many shards, each computed by one thread; gradients are added in shard
  /// order, so results depend on `shards` but not on the number of threads. On CUDA one shard is
  /// used.
  int shards = 2;
  double checkpoint_seconds = 60;
  /// "float32", "mixed" (model/networks/precision.h), or "auto": mixed on processors that multiply
  /// bfloat, else float32. How a stage is computed, not what: changing it trains nothing anew, and
  /// a checkpoint goes on in the other one.
  std::string precision = "auto";

  int mids_per_segment =
      2;  ///< frames inside each segment that are used besides its start and goal

  /// "none" (paper) or "dihedral": the 8 flips and quarter turns of a picture, for square pictures
  /// from straight above of worlds without a preferred direction. Turned pictures get all labels of
  /// the original. Or, beyond the paper, "camera": as if from slightly other cameras and of other
  /// colours (model/training/views.h), for few trials of a world that looks different in each.
  std::string augment = "none";
  /// Encodings cached of each frame: of so many of its varied pictures (1 to 8).
  int hidden_variants = 1;

  /// Beyond the paper: weight of pixels that differ from the mean training picture, 0 = plain L1.
  /// In scenes that are mostly one background the plain L1 is slow to learn that there are objects
  /// at all.
  double focus = 0.0;

  /// Beyond the paper: weight of the landmarks' cross-entropy (model/training/landmarks.h) in the
  /// losses of C, of the encoder, and of T; 0, or a data set without landmarks, leaves it out.
  double landmark_weight = 0.0;

  /// Beyond the paper: weight, in the encoder's loss, of the squared logarithm of the light gain
  /// (model/networks/light.h). Pictures are compared in their own light, so nothing else keeps the
  /// decoder from painting one state of a scene darker than the next; where it does, predictions,
  /// which are shown in the light of the first picture, come out too dark or too bright. 0 = off.
  double gain_weight = 0.0;

  StageConfig classifier;  ///< C, and the second classifier; 0 iterations: neither, unless begun
                           ///< from weights
  StageConfig encoder_decoder;  ///< f_enc and f_dec
  StageConfig
      transform_hidden;  ///< beyond the paper: T against encodings of the goal pictures; may be 0
  StageConfig transform_image;  ///< the paper's loss of T through the frozen decoder
  /// V, Q, p, f; 0 iterations: none of them. They need failures: where all trials and actions of
  /// the training part succeeded and `heads_need_failures`, they are left out as well.
  StageConfig heads;
  bool heads_need_failures = false;

  double lambda = 1e-3;  ///< weight of C's cross-entropy on the second picture (authors' code)
  int linked_steps = 2;  ///< transforms trained one after another (paper: 2)
  /// Beyond the paper: T on encodings begins with so many linked steps, which grow evenly to
  /// `linked_steps` over the first half of its iterations; 0: all from the start.
  int linked_from = 0;
  bool repeat_last =
      true;  ///< after a trial's last action the same action again (authors' code); else no loss
  /// Weight of the pictures' L1 in T's loss; beside an adversary the authors use 100 (pix2pix) and
  /// 0.1 (wgan).
  double picture_weight = 1.0;
  /// "none", or the judge in T's loss on pictures (model/training/adversary.h): "pix2pix" or
  /// "wgan". Needs two linked steps.
  std::string adversary = "none";
  /// Encoder and decoder learn on with T in its loss on pictures, instead of staying as they are.
  bool finetune = false;
  int judge_steps = 10;      ///< wgan: iterations of the judge alone before each of T
  double judge_clip = 0.01;  ///< wgan: its weights stay within +- this
  double judge_rate = 2.0;   ///< its learning rate, as a multiple of T's (authors' code)
  double start_share =
      0.5;  ///< share of T's samples that begin at a segment's first frame, not inside
  /// Beyond the paper: weight of the loss of a head like f on T's states, passed on to T, so that T
  /// keeps in the hidden state whether the action succeeded. 0 = off.
  double done_weight = 0.0;
  /// Beyond the paper: share of the heads' loss on states imagined by T (chains of whole plans); 0
  /// = the paper's.
  double imagined_share = 0.5;
  /// Weight of f's loss on frames inside an action (label 0), beside 1 on the frame that ends it.
  /// Where the last tenths of a second look alike, they teach f to say "perhaps" of every end.
  double inside_weight = 1.0;
  /// Imagined pictures keep what was seen where the decoder shows no change (ComposePicture in
  /// model/networks/light.h). Nothing is trained differently.
  bool compose = true;
  /// What V, Q, p and f are taught (StateLabels in model/training/heads_stage.h): "paper" or
  /// "authors".
  std::string labels = "paper";
};

/// Scales the iterations of every stage so that T's (hidden + image) become `transform_iterations`.
void ScaleIterations(std::int64_t transform_iterations, TrainConfig* config);

/// The configuration with the precision that "auto" stands for on `device` ("cpu" or "cuda") of
/// this machine.
TrainConfig Resolved(TrainConfig config, const std::string& device);

/// Throws std::invalid_argument naming the field that is out of range or no number.
void Validate(const TrainConfig& config);

void to_json(nlohmann::json& json, const StageConfig& config);
void from_json(const nlohmann::json& json, StageConfig& config);
void to_json(nlohmann::json& json, const TrainConfig& config);
/// Missing keys keep their present values; unknown keys throw std::invalid_argument.
void from_json(const nlohmann::json& json, TrainConfig& config);

}  // namespace prospect::model
