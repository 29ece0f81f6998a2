#include "model/inference/packed_matrix.h"

#include <cstddef>

namespace prospect::model::inference {

PackedMatrix::PackedMatrix(const Kernels& kernels, int inputs, int outputs,
                           const std::vector<float>& weights)
    : inputs_(inputs), outputs_(outputs) {
  const int panels = (outputs + kernels.panel - 1) / kernels.panel;
  packed_.resize(static_cast<std::size_t>(panels) * static_cast<std::size_t>(inputs) *
                 static_cast<std::size_t>(kernels.panel));
  float* at = packed_.data();
  for (int first = 0; first < outputs; first += kernels.panel) {
    for (int k = 0; k < inputs; ++k) {
      const float* row = weights.data() + static_cast<std::ptrdiff_t>(k) * outputs;
      for (int n = first; n < first + kernels.panel; ++n) *at++ = n < outputs ? row[n] : 0.0F;
    }
  }
}

void MultiplyRows(const Kernels& kernels, const PackedMatrix& weights, const float* from, int rows,
                  float* to, Arena& arena) {
  const Arena::Scope scope(arena);
  const auto count = static_cast<std::size_t>(rows);
  auto** const froms = arena.Take<const float*>(count);
  auto** const tos = arena.Take<float*>(count);
  for (int i = 0; i < rows; ++i) {
    froms[i] = from + static_cast<std::ptrdiff_t>(i) * weights.inputs();
    tos[i] = to + static_cast<std::ptrdiff_t>(i) * weights.outputs();
  }
  kernels.multiply({froms, tos, rows, 1, weights.inputs(), 0}, weights.data(), weights.outputs());
}

}  // namespace prospect::model::inference
