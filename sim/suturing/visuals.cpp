#include "sim/suturing/visuals.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "sim/suturing/needle.h"

namespace prospect::sim {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr float kMm = 1e-3f;
constexpr double kTexelsPerMeter = 8000;

float F(double value) { return static_cast<float>(value); }

// A box that narrows along z from `foot` to `top` (sizes in x and y).
VisualPart Wedge(const Vector3f& low, const Eigen::Vector2f& foot, const Vector3f& high,
                 const Eigen::Vector2f& top, const Color& color) {
  VisualPart part = Box(Vector3f::Zero(), Vector3f::Ones(), color);
  for (Vector3f& v : part.mesh.vertices) {
    const Eigen::Vector2f& size = v.z() < 0 ? foot : top;
    const Vector3f& at = v.z() < 0 ? low : high;
    v = at + Vector3f(v.x() * size.x(), v.y() * size.y(), 0);
  }
  return part;
}

// A smooth random field: lattice values by hash, blended; about -1 to 1.
double Field(double x, double y, std::uint64_t seed) {
  const double fx = std::floor(x), fy = std::floor(y);
  const auto at = [&](int dx, int dy) {
    const auto ix = static_cast<std::uint64_t>(static_cast<std::int64_t>(fx) + dx);
    const auto iy = static_cast<std::uint64_t>(static_cast<std::int64_t>(fy) + dy);
    return static_cast<double>(base::MixSeeds({seed, ix, iy}) >> 11) * 0x1.0p-52 - 1;
  };
  const auto smooth = [](double t) { return t * t * (3 - 2 * t); };
  const double u = smooth(x - fx), v = smooth(y - fy);
  const double low = at(0, 0) + u * (at(1, 0) - at(0, 0));
  const double high = at(0, 1) + u * (at(1, 1) - at(0, 1));
  return low + v * (high - low);
}

}  // namespace

VisualBody JawVisual(const SuturingParameters& p) {
  const Color steel(0.62f, 0.64f, 0.68f), edge(0.40f, 0.41f, 0.44f);
  const float length = F(p.wrist) + 1.5f * kMm;
  VisualBody body;
  body.push_back(Wedge({0.9f * kMm, 0, 0}, {2.2f * kMm, 4.0f * kMm},
                       {0.7f * kMm, 0, 0.45f * length}, {1.8f * kMm, 3.6f * kMm}, steel));
  body.push_back(Wedge({0.7f * kMm, 0, 0.45f * length}, {1.6f * kMm, 3.2f * kMm},
                       {0.6f * kMm, 0, length}, {1.0f * kMm, 2.0f * kMm}, edge));
  return body;
}

VisualBody WristVisual(const SuturingParameters&) {
  const Color steel(0.52f, 0.54f, 0.58f), dark(0.20f, 0.21f, 0.23f);
  VisualBody body;
  body.push_back(Cylinder({0, 0, -1.5f * kMm}, 2.9f * kMm, 5.5f * kMm, steel));
  body.push_back(Cylinder({0, 0, 0}, 2.3f * kMm, 6.4f * kMm, dark, Axis::kY));
  return body;
}

VisualBody ShaftVisual(const SuturingParameters&) {
  const Color black(0.085f, 0.085f, 0.095f), ring(0.45f, 0.46f, 0.50f);
  VisualBody body;
  body.push_back(Cylinder({0, 0, 2.0f * kMm}, 3.4f * kMm, 6.0f * kMm, ring));
  body.push_back(Cylinder({0, 0, 65.0f * kMm}, 3.9f * kMm, 120.0f * kMm, black));
  return body;
}

VisualBody NeedleVisual(const SuturingParameters& p) {
  constexpr int kAlong = 36, kAround = 8;
  VisualPart part;
  part.color = Color(0.80f, 0.82f, 0.86f);
  for (int i = 0; i <= kAlong; ++i) {
    const double angle = M_PI * i / kAlong;
    const Vector3d out(std::cos(angle), std::sin(angle), 0);
    const double wire = p.wire_radius * std::min(1.0, 0.15 + 5.0 * i / kAlong);  // a sharp tip
    for (int k = 0; k < kAround; ++k) {
      const double turn = 2 * M_PI * k / kAround;
      const Vector3d at = p.needle_radius * out +
                          wire * (std::cos(turn) * out + std::sin(turn) * Vector3d::UnitZ());
      part.mesh.vertices.push_back(at.cast<float>());
    }
  }
  for (std::uint32_t i = 0; i < kAlong; ++i) {
    for (std::uint32_t k = 0; k < kAround; ++k) {
      const std::uint32_t a = i * kAround + k, b = i * kAround + (k + 1) % kAround;
      part.mesh.triangles.push_back({a, b, a + kAround});
      part.mesh.triangles.push_back({b, b + kAround, a + kAround});
    }
  }
  return {part};
}

VisualBody StillVisual(const SuturingParameters& p, const SuturingLook& look) {
  const float depth = F(p.pad_height), table = 2 * F(p.half_table);
  VisualBody body;
  body.push_back(
      Box({0, 0, -depth / 2}, {2 * F(p.half_width), 2 * F(p.half_length), depth}, look.pad));
  body.push_back(Box({0, 0, -depth - 1 * kMm}, {table, table, 2 * kMm}, look.table));
  return body;
}

PadTexture::PadTexture(const SuturingParameters& p, const SuturingLook& look)
    : half_width_(F(p.half_width)),
      half_length_(F(p.half_length)),
      columns_(static_cast<int>(2 * p.half_width * kTexelsPerMeter)),
      rows_(static_cast<int>(2 * p.half_length * kTexelsPerMeter)),
      texels_(static_cast<std::size_t>(columns_) * rows_) {
  Mottle(look);
  Mark(p, look);
}

void PadTexture::Mottle(const SuturingLook& look) {
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      const double x = column / kTexelsPerMeter * 1e3, y = row / kTexelsPerMeter * 1e3;  // mm
      const double coarse = Field(x / 14, y / 14, look.texture);
      const double fine = Field(x / 3.1, y / 3.1, look.texture + 1);
      const double red = Field(x / 9, y / 9, look.texture + 2);
      const auto shade = F(1 + 0.06 * coarse + 0.035 * fine);
      const Color blush(1.f, F(1 - 0.05 * red), F(1 - 0.06 * red));
      Texel(column, row) = look.pad.cwiseProduct(blush) * shade;
    }
  }
}

void PadTexture::Mark(const SuturingParameters& p, const SuturingLook& look) {
  constexpr double kDot = 1.1, kSoft = 0.3, kCut = 0.7;  // mm
  const double end = (p.first_throw + 0.5 * p.throw_gap) * 1e3;
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      const double x = column / kTexelsPerMeter * 1e3 - half_width_ * 1e3;
      const double y = row / kTexelsPerMeter * 1e3 - half_length_ * 1e3;
      Color& texel = Texel(column, row);
      const double bend = 0.5 * Field(y / 7, 0, look.texture + 3);
      const double width = kCut * std::clamp((end + 2 - std::abs(y)) / 6, 0.0, 1.0);
      const double cut = std::clamp((width - std::abs(x - bend)) / kSoft + 0.5, 0.0, 1.0);
      texel += F(width > 0 ? cut : 0) * (look.cut - texel);
      const double lip = std::clamp(1 - std::abs(std::abs(x - bend) - width - 0.9) / 0.9, 0.0, 1.0);
      texel *= F(1 + (width > 0 ? 0.08 * lip : 0));
      for (int i = 0; i < p.throws; ++i) {
        for (const Vector3d& dot : {EntryDot(p, i), ExitDot(p, i)}) {
          const double off_x = x - dot.x() * 1e3, off_y = y - dot.y() * 1e3;
          if (std::max(std::abs(off_x), std::abs(off_y)) > kDot + kSoft) continue;
          const double off = std::hypot(off_x, off_y);
          if (off > kDot + kSoft) continue;
          texel += F(std::clamp((kDot - off) / kSoft + 0.5, 0.0, 1.0)) * (look.dot - texel);
        }
      }
    }
  }
}

Color PadTexture::At(float x, float y) const {
  const float u = std::clamp((x + half_width_) * F(kTexelsPerMeter), 0.f, columns_ - 1.001f);
  const float v = std::clamp((y + half_length_) * F(kTexelsPerMeter), 0.f, rows_ - 1.001f);
  const int column = static_cast<int>(u), row = static_cast<int>(v);
  const float s = u - column, t = v - row;
  const Color low = Texel(column, row) + s * (Texel(column + 1, row) - Texel(column, row));
  const Color high =
      Texel(column, row + 1) + s * (Texel(column + 1, row + 1) - Texel(column, row + 1));
  return low + t * (high - low);
}

}  // namespace prospect::sim
