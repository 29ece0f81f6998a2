#pragma once

#include <torch/torch.h>

#include <vector>

#include "model/training/random.h"
#include "model/training/train_config.h"

namespace prospect::model {

/// Training pictures are varied so that what happens in them stays what it is
/// (TrainConfig::augment). A variation is a number, its element: 0 leaves a picture as it is; 1 to
/// 7 are the flips and quarter turns of square pictures (1-3 quarter turns, 4-7 the same after a
/// left-right flip); 8 and above are other cameras: moved by up to 5 % of the picture's size,
/// turned by up to 2 degrees, up to 5 % closer or farther, and tinted by up to 8 % a channel. Pure
/// functions, callable from any thread.
inline constexpr int kTurns = 8;
inline constexpr int kCameras = 256;

/// Pictures [B,3,H,W] in [0,1] varied by one element; contiguous where the element is not a turn.
torch::Tensor View(const torch::Tensor& pictures, int element);

/// Each picture of [B,3,H,W] varied in its own way; contiguous.
torch::Tensor View(const torch::Tensor& pictures, const std::vector<int>& elements);

/// Maps [B,C,H,W] over pictures, moved as View moves the pictures; tints do not apply to them.
torch::Tensor MovedAsView(const torch::Tensor& maps, int element);
torch::Tensor MovedAsView(const torch::Tensor& maps, const std::vector<int>& elements);

/// The element by which variant `variant` of the pictures of one trial is varied. It differs from
/// trial to trial, so that few variants a picture still show all of them to T and the heads.
/// Cameras: variant 0 is the picture itself.
int ViewOf(const TrainConfig& config, int trial_index, int variant);

/// An element for a picture of a batch. Cameras: every other picture is left as it is.
int DrawView(const TrainConfig& config, CounterRandom* random);

}  // namespace prospect::model
