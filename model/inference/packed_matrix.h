#pragma once

#include <vector>

#include "model/inference/arena.h"
#include "model/inference/kernels.h"

namespace prospect::model::inference {

/// The weights of a product as the kernels read them: panels of outputs, padded with zeros.
/// Immutable.
class PackedMatrix {
 public:
  PackedMatrix() = default;
  /// @param weights inputs x outputs numbers, row major
  PackedMatrix(const Kernels& kernels, int inputs, int outputs, const std::vector<float>& weights);

  const float* data() const { return packed_.data(); }
  int inputs() const { return inputs_; }
  int outputs() const { return outputs_; }

 private:
  int inputs_ = 0, outputs_ = 0;
  std::vector<float> packed_;
};

/// Whole rows of `from`, one after the other, times `weights`, to rows of `to`.
void MultiplyRows(const Kernels& kernels, const PackedMatrix& weights, const float* from, int rows,
                  float* to, Arena& arena);

}  // namespace prospect::model::inference
