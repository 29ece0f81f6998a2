#pragma once

/// What networks, weights files and the engine use of libtorch. All of it (<torch/torch.h>) takes
/// twice as long to compile; training uses that, precompiled.
#include <torch/nn/init.h>
#include <torch/nn/modules/container/modulelist.h>
#include <torch/nn/modules/container/sequential.h>
#include <torch/nn/modules/conv.h>
#include <torch/nn/modules/linear.h>
#include <torch/utils.h>
