#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

/// The inner loops of inference, compiled once for each instruction set. Maps of features lie pixel
/// by pixel, the channels of a pixel together. Where a function says `channels`, they are a
/// multiple of 16 unless it says otherwise. Every number is computed by the same operations in the
/// same order whatever is computed beside it, so no result depends on its neighbours. Functions are
/// pure and thread-safe; nothing is allocated.
namespace prospect::model::inference {

enum class Activation { kNone, kRelu, kLeakyRelu };

/// Rows of a matrix product, each from and to a place of its own. A row is `runs` runs of `run`
/// numbers, each run `stride` numbers after the one before: so a row can be the window of a
/// convolution where it lies.
struct ProductRows {
  const float* const* from = nullptr;
  float* const* to = nullptr;
  int count = 0;
  int runs = 1;
  int run = 0;
  std::ptrdiff_t stride = 0;
};

/// Numbers added to each pixel of a map before it is normalised.
struct AddedMap {
  const float* values = nullptr;  ///< rows of `channels` numbers; null: nothing is added
  const std::int32_t* row_of_pixel = nullptr;  ///< which row a pixel gets; null: the pixel's own
};

struct NormWeights {
  const float* scale = nullptr;
  const float* shift = nullptr;
  const float* modulation = nullptr;  ///< 2 x channels (scale, then shift), or null
};

struct Kernels {
  const char* name;  ///< of the instruction set
  int panel;         ///< outputs that a product computes at once; packed weights are padded to it

  /// rows x weights: `weights` holds panels of `panel` outputs, each runs x run x panel numbers;
  /// `outputs` numbers are written a row. A number is the sum over its row from first to last.
  void (*multiply)(const ProductRows& rows, const float* weights, int outputs);

  /// Winograd's transforms for output tiles of 4 x 4 and windows of 5 x 5 (8 x 8 points) or 3 x 3
  /// (6 x 6). In: the tile's input pixels, row major, to one number a point and channel, points
  /// `stride` apart.
  void (*winograd_in_5)(const float* const* pixels, int channels, float* points,
                        std::ptrdiff_t stride);
  void (*winograd_in_3)(const float* const* pixels, int channels, float* points,
                        std::ptrdiff_t stride);
  /// Out: points to the 16 output pixels; null where there is no pixel.
  void (*winograd_out_5)(const float* points, std::ptrdiff_t stride, int channels,
                         float* const* pixels);
  void (*winograd_out_3)(const float* points, std::ptrdiff_t stride, int channels,
                         float* const* pixels);

  /// Instance norm of a map after `added`, in place; then the modulation, then the activation.
  void (*normalise)(float* map, int pixels, int channels, const AddedMap& added,
                    const NormWeights& weights, Activation activation);

  /// Adds up to two vectors or maps and activates: x[i] += a[i] + b[i] for i < count (any number);
  /// b may be null.
  void (*add)(float* x, std::size_t count, const float* a, const float* b, Activation activation);

  /// x = 1 / (1 + exp(-x)), any count.
  void (*sigmoid)(float* x, std::size_t count);

  /// Expected position of each channel's softmax over the grid: channel's row then column, each
  /// from -1 to 1, 2 x channels numbers.
  void (*soft_argmax)(const float* map, int height, int width, int channels, float* positions);
};

/// Those of the best instruction set that this processor has.
const Kernels& BestKernels();

/// All that this processor can run, the best first.
std::vector<const Kernels*> RunnableKernels();

}  // namespace prospect::model::inference
