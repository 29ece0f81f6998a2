// Included by one file an instruction set, which is compiled for it and defines PROSPECT_LANES, the
// floats of a vector, and PROSPECT_TILE_ROWS, the rows of a product that its registers hold.
// Nothing of the standard library is used here but sizes: an inline function compiled for one
// instruction set could be linked into code that runs on all.
#include "model/inference/kernels.h"

namespace prospect::model::inference {
namespace {

constexpr int kLanes = PROSPECT_LANES;
constexpr int kVectors = 2;  // of a panel
constexpr int kPanel = kVectors * kLanes;
constexpr int kTileRows = PROSPECT_TILE_ROWS;
constexpr float kNormEpsilon = 1e-5F;
constexpr float kLeakySlope = 0.2F;

using Vector = float __attribute__((vector_size(kLanes * 4)));
using Integers = std::int32_t __attribute__((vector_size(kLanes * 4)));
using Unaligned = float __attribute__((vector_size(kLanes * 4), aligned(4), may_alias));

inline Vector Load(const float* from) { return *reinterpret_cast<const Unaligned*>(from); }
inline void Store(float* to, Vector values) { *reinterpret_cast<Unaligned*>(to) = values; }
inline Vector All(float value) { return value - Vector{}; }
inline Vector Larger(Vector a, Vector b) { return a > b ? a : b; }
inline Vector Smaller(Vector a, Vector b) { return a < b ? a : b; }

/// Vectors of an array of any length: the last one is padded with zeros.
template <typename Function>
void ForEachVector(float* x, std::size_t count, const Function& function) {
  std::size_t i = 0;
  for (; i + kLanes <= count; i += kLanes) Store(x + i, function(i, Load(x + i), kLanes));
  if (i == count) return;
  const int left = static_cast<int>(count - i);
  float padded[kLanes] = {};
  for (int j = 0; j < left; ++j) padded[j] = x[i + static_cast<std::size_t>(j)];
  Store(padded, function(i, Load(padded), left));
  for (int j = 0; j < left; ++j) x[i + static_cast<std::size_t>(j)] = padded[j];
}

inline Vector LoadSome(const float* from, int count) {
  if (count == kLanes) return Load(from);
  float padded[kLanes] = {};
  for (int j = 0; j < count; ++j) padded[j] = from[j];
  return Load(padded);
}

inline Vector Activated(Vector x, Activation activation) {
  if (activation == Activation::kNone) return x;
  const Vector slope = All(activation == Activation::kRelu ? 0.0F : kLeakySlope);
  return x > 0 ? x : x * slope;
}

/// exp within 2 units in the last place: 2^n times a polynomial of what is left (Cephes' expf).
inline Vector Exp(Vector x) {
  x = Smaller(Larger(x, All(-87.0F)), All(88.0F));
  const Vector magic = All(12582912.0F);  // adding it leaves the nearest integer in the last bits
  const Vector shifted = x * 1.44269504088896341F + magic;
  const Vector n = shifted - magic;
  const Vector r = x - n * 0.693359375F + n * 2.12194440e-4F;
  Vector y = r * 1.9875691500e-4F + 1.3981999507e-3F;
  y = y * r + 8.3334519073e-3F;
  y = y * r + 4.1665795894e-2F;
  y = y * r + 1.6666665459e-1F;
  y = y * r + 5.0000001201e-1F;
  y = y * r * r + r + 1.0F;
  const Integers power = ((Integers)shifted << 23) + 0x3f800000;
  return y * (Vector)power;
}

// ---- products ----

/// `kRows` rows by one panel: every sum stays in a register from first to last.
template <int kRows>
void MultiplyTile(const float* const* from, const ProductRows& rows, const float* weights,
                  Vector (&sums)[kRows][kVectors]) {
  const float* at[kRows];
  for (int i = 0; i < kRows; ++i) at[i] = from[i];
  Vector sum[kRows][kVectors] = {};
  for (int r = 0; r < rows.runs; ++r) {
    for (int k = 0; k < rows.run; ++k) {
      const Vector first = Load(weights), second = Load(weights + kLanes);
      weights += kPanel;
#pragma GCC unroll 8
      for (int i = 0; i < kRows; ++i) {
        const float x = at[i][k];
        sum[i][0] += x * first;
        sum[i][1] += x * second;
      }
    }
    for (int i = 0; i < kRows; ++i) at[i] += rows.stride;
  }
  for (int i = 0; i < kRows; ++i) {
    for (int v = 0; v < kVectors; ++v) sums[i][v] = sum[i][v];
  }
}

inline void StorePanel(const Vector (&sums)[kVectors], int outputs, float* to) {
  if (outputs >= kPanel) {
    for (int v = 0; v < kVectors; ++v) Store(to + v * kLanes, sums[v]);
    return;
  }
  float whole[kPanel];
  for (int v = 0; v < kVectors; ++v) Store(whole + v * kLanes, sums[v]);
  for (int n = 0; n < outputs; ++n) to[n] = whole[n];
}

/// Rows from `first` on in tiles of kRows, what is left in smaller ones.
template <int kRows>
void MultiplyPanel(const ProductRows& rows, int first, const float* weights, int panel_at,
                   int outputs) {
  for (; first + kRows <= rows.count; first += kRows) {
    Vector sums[kRows][kVectors];
    MultiplyTile<kRows>(rows.from + first, rows, weights, sums);
    for (int i = 0; i < kRows; ++i) StorePanel(sums[i], outputs, rows.to[first + i] + panel_at);
  }
  if constexpr (kRows > 1) {
    if (first < rows.count) MultiplyPanel<kRows / 2>(rows, first, weights, panel_at, outputs);
  }
}

void Multiply(const ProductRows& rows, const float* weights, int outputs) {
  const std::ptrdiff_t panel_size = std::ptrdiff_t{rows.runs} * rows.run * kPanel;
  for (int at = 0; at < outputs; at += kPanel, weights += panel_size)
    MultiplyPanel<kTileRows>(rows, 0, weights, at, outputs - at);
}

// ---- Winograd: interpolation at 0, 1, -1, 2, -2, 1/2, -1/2 and infinity, or the first five and
// infinity (Lavin and Gray 2016) ----

struct Five {
  static constexpr int kPoints = 8;
  static void In(Vector (&d)[8]) {
    const Vector a = d[2] + d[6] - d[4] * 4.25F, b = d[1] + d[5] - d[3] * 4.25F;
    const Vector c = d[6] + d[2] * 0.25F - d[4] * 1.25F;
    const Vector e = d[1] * 0.5F - d[3] * 2.5F + d[5] * 2.0F;
    const Vector f = d[6] + (d[2] - d[4] * 1.25F) * 4.0F;
    const Vector g = d[1] * 2.0F - d[3] * 2.5F + d[5] * 0.5F;
    const Vector first = d[0] - d[6] + (d[4] - d[2]) * 5.25F;
    const Vector last = d[7] - d[1] + (d[3] - d[5]) * 5.25F;
    d[0] = first, d[7] = last;
    d[1] = a + b, d[2] = a - b;
    d[3] = c + e, d[4] = c - e;
    d[5] = f + g, d[6] = f - g;
  }
  static void Out(const Vector (&m)[8], Vector (&y)[4]) {
    const Vector a = m[1] + m[2], b = m[1] - m[2], c = m[3] + m[4], d = m[3] - m[4];
    const Vector e = m[5] + m[6], f = m[5] - m[6];
    y[0] = m[0] + a + c + e;
    y[1] = b + d * 2.0F + f * 0.5F;
    y[2] = a + c * 4.0F + e * 0.25F;
    y[3] = b + d * 8.0F + f * 0.125F + m[7];
  }
};

struct Three {
  static constexpr int kPoints = 6;
  static void In(Vector (&d)[6]) {
    const Vector a = d[4] - d[2] * 4.0F, b = d[3] - d[1] * 4.0F;
    const Vector c = d[4] - d[2], e = (d[3] - d[1]) * 2.0F;
    const Vector first = d[0] * 4.0F - d[2] * 5.0F + d[4];
    const Vector last = d[1] * 4.0F - d[3] * 5.0F + d[5];
    d[0] = first, d[5] = last;
    d[1] = a + b, d[2] = a - b;
    d[3] = c + e, d[4] = c - e;
  }
  static void Out(const Vector (&m)[6], Vector (&y)[4]) {
    const Vector a = m[1] + m[2], b = m[1] - m[2], c = m[3] + m[4], d = m[3] - m[4];
    y[0] = m[0] + a + c;
    y[1] = b + d * 2.0F;
    y[2] = a + c * 4.0F;
    y[3] = b + d * 8.0F + m[5];
  }
};

template <typename Window>
void WinogradIn(const float* const* pixels, int channels, float* points, std::ptrdiff_t stride) {
  constexpr int kPoints = Window::kPoints;
  for (int c = 0; c < channels; c += kLanes) {
    Vector d[kPoints][kPoints], line[kPoints];
    for (int x = 0; x < kPoints; ++x) {
      for (int y = 0; y < kPoints; ++y) line[y] = Load(pixels[y * kPoints + x] + c);
      Window::In(line);
      for (int y = 0; y < kPoints; ++y) d[y][x] = line[y];
    }
    for (int y = 0; y < kPoints; ++y) {
      Window::In(d[y]);
      for (int x = 0; x < kPoints; ++x) Store(points + (y * kPoints + x) * stride + c, d[y][x]);
    }
  }
}

template <typename Window>
void WinogradOut(const float* points, std::ptrdiff_t stride, int channels, float* const* pixels) {
  constexpr int kPoints = Window::kPoints;
  for (int c = 0; c < channels; c += kLanes) {
    Vector half[4][kPoints], line[kPoints], out[4];
    for (int x = 0; x < kPoints; ++x) {
      for (int y = 0; y < kPoints; ++y) line[y] = Load(points + (y * kPoints + x) * stride + c);
      Window::Out(line, out);
      for (int y = 0; y < 4; ++y) half[y][x] = out[y];
    }
    for (int y = 0; y < 4; ++y) {
      Window::Out(half[y], out);
      for (int x = 0; x < 4; ++x) {
        if (pixels[y * 4 + x]) Store(pixels[y * 4 + x] + c, out[x]);
      }
    }
  }
}

// ---- what follows a convolution ----

/// Sum over all pixels of `value(pixel)`, in parts of 16 pixels, which rounds less than one long
/// sum.
template <typename Value>
Vector Sum(int pixels, const Value& value) {
  Vector total = {};
  for (int begin = 0; begin < pixels; begin += 16) {
    Vector part = {};
    const int end = begin + 16 < pixels ? begin + 16 : pixels;
    for (int p = begin; p < end; ++p) part += value(p);
    total += part;
  }
  return total;
}

inline Vector RootOf(Vector x) {
  for (int i = 0; i < kLanes; ++i) x[i] = __builtin_sqrtf(x[i]);
  return x;
}

void Normalise(float* map, int pixels, int channels, const AddedMap& added,
               const NormWeights& weights, Activation activation) {
  for (int c = 0; c < channels; c += kLanes) {
    float* const at = map + c;
    const auto pixel = [=](int p) { return at + std::ptrdiff_t{p} * channels; };
    const Vector sum = Sum(pixels, [&](int p) {
      Vector x = Load(pixel(p));
      if (added.values) {
        const std::ptrdiff_t row = added.row_of_pixel ? added.row_of_pixel[p] : p;
        x += Load(added.values + row * channels + c);
        Store(pixel(p), x);
      }
      return x;
    });
    const Vector mean = sum / All(static_cast<float>(pixels));
    const Vector squares = Sum(pixels, [&](int p) {
      const Vector away = Load(pixel(p)) - mean;
      return away * away;
    });
    const Vector deviation = RootOf(squares / All(static_cast<float>(pixels)) + kNormEpsilon);
    Vector scale = Load(weights.scale + c), shift = Load(weights.shift + c);
    if (weights.modulation) {
      const Vector more = Load(weights.modulation + c) + 1.0F;
      scale = scale * more;
      shift = shift * more + Load(weights.modulation + channels + c);
    }
    scale = scale / deviation;
    for (int p = 0; p < pixels; ++p)
      Store(pixel(p), Activated((Load(pixel(p)) - mean) * scale + shift, activation));
  }
}

void Add(float* x, std::size_t count, const float* a, const float* b, Activation activation) {
  ForEachVector(x, count, [&](std::size_t i, Vector value, int n) {
    value += LoadSome(a + i, n);
    if (b) value += LoadSome(b + i, n);
    return Activated(value, activation);
  });
}

void Sigmoid(float* x, std::size_t count) {
  ForEachVector(x, count,
                [](std::size_t, Vector value, int) { return 1.0F / (1.0F + Exp(-value)); });
}

/// Place of line i of n, from -1 to 1.
inline float Place(int i, int n) {
  return n > 1 ? static_cast<float>(2 * i) / static_cast<float>(n - 1) - 1.0F : -1.0F;
}

void SoftArgmax(const float* map, int height, int width, int channels, float* positions) {
  for (int c = 0; c < channels; c += kLanes) {
    Vector most = Load(map + c);
    for (int p = 1; p < height * width; ++p)
      most = Larger(most, Load(map + std::ptrdiff_t{p} * channels + c));
    Vector total = {}, down = {}, across = {};
    for (int y = 0; y < height; ++y) {
      Vector line = {};
      for (int x = 0; x < width; ++x) {
        const Vector e = Exp(Load(map + std::ptrdiff_t{y * width + x} * channels + c) - most);
        line += e;
        across += e * Place(x, width);
      }
      total += line;
      down += line * Place(y, height);
    }
    down = down / total, across = across / total;
    for (int i = 0; i < kLanes; ++i) {
      positions[2 * (c + i)] = down[i];
      positions[2 * (c + i) + 1] = across[i];
    }
  }
}

constexpr Kernels MakeKernels(const char* name) {
  return {name,
          kPanel,
          Multiply,
          WinogradIn<Five>,
          WinogradIn<Three>,
          WinogradOut<Five>,
          WinogradOut<Three>,
          Normalise,
          Add,
          Sigmoid,
          SoftArgmax};
}

}  // namespace
}  // namespace prospect::model::inference
