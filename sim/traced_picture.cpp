#include "sim/traced_picture.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>

namespace prospect::sim {
namespace {

constexpr int kKept = 128 * 128;  // pixels at most

std::uint8_t ToByte(float value) {
  return static_cast<std::uint8_t>(std::clamp(std::lround(value * 255.f), 0L, 255L));
}

// Whether a pixel's four corners show nearly one colour; their mean goes to *color.
bool Agree(const Color above[2], const Color below[2], float alike, Color* color) {
  const Color low = above[0].cwiseMin(above[1]).cwiseMin(below[0]).cwiseMin(below[1]);
  const Color high = above[0].cwiseMax(above[1]).cwiseMax(below[0]).cwiseMax(below[1]);
  *color = (above[0] + above[1] + below[0] + below[1]) * 0.25f;
  return (high - low).maxCoeff() < alike;
}

void Put(const Color& color, float light, int x, int y, Image* image) {
  const Color scaled = color * light;
  std::uint8_t* pixel = &image->rgb[(static_cast<std::size_t>(y) * image->width + x) * 3];
  for (int k = 0; k < 3; ++k) pixel[k] = ToByte(scaled[k]);
}

Image Blank(int width, int height) {
  Image image;
  image.width = width;
  image.height = height;
  image.rgb.resize(static_cast<std::size_t>(width) * height * 3);
  return image;
}

}  // namespace

void CheckPictureSize(int width, int height) {
  if (width < 1 || height < 1 || width > 4096 || height > 4096) {
    throw std::invalid_argument("a picture is 1 to 4096 pixels wide and high");
  }
}

bool KeepsPicture(int width, int height) { return width * height <= kKept; }

Image TracedPicture::Render(int width, int height, double light, const PictureChanges* changes,
                            const TraceRays& trace) {
  CheckPictureSize(width, height);
  const auto scale = static_cast<float>(light);
  if (changes != nullptr) {
    if (changes->everything()) {
      image_ = Blank(width, height);
      Begin(width, height, 0, height, &kept_);
    }
    Update(&kept_, changes->everything() ? nullptr : changes, trace, scale, &image_);
    return image_;
  }
  Image image = Blank(width, height);
  const int count = std::max(1, kKept / width);
  Rows rows;
  for (int top = 0; top < height; top += count) {
    Begin(width, height, top, std::min(count, height - top), &rows);
    Update(&rows, nullptr, trace, scale, &image);
  }
  return image;
}

void TracedPicture::Begin(int width, int height, int top, int count, Rows* rows) const {
  rows->width = width;
  rows->height = height;
  rows->top = top;
  rows->count = count;
  const std::size_t corners = static_cast<std::size_t>(width + 1) * (count + 1);
  const std::size_t pixels = static_cast<std::size_t>(width) * count;
  rows->corners.resize(corners);
  rows->trails.resize(corners);
  rows->corner_changed.resize(corners);
  rows->fine.assign(pixels, 0);
  rows->fine_trails.resize(pixels);
}

// Without `changes`, all are traced.
void TracedPicture::Update(Rows* rows, const PictureChanges* changes, const TraceRays& trace,
                           float light, Image* image) {
  TraceCorners(rows, changes, trace);
  ListFine(rows, changes, light, image);
  TraceFine(rows, trace, light, image);
}

void TracedPicture::TraceCorners(Rows* rows, const PictureChanges* changes,
                                 const TraceRays& trace) {
  const int across = rows->width + 1, total = across * (rows->count + 1);
  listed_.clear();
  for (int i = 0; i < total; ++i) {
    rows->corner_changed[i] = changes == nullptr;
    if (changes == nullptr || changes->Covers(i % across, rows->top + i / across) ||
        changes->Touches(rows->trails[i])) {
      listed_.push_back(i);
    }
  }
  for (std::size_t first = 0; first < listed_.size(); first += kLanes) {
    const auto count = static_cast<int>(std::min<std::size_t>(kLanes, listed_.size() - first));
    float u[kLanes], v[kLanes];
    for (int lane = 0; lane < kLanes; ++lane) {
      const int i = listed_[first + std::min(lane, count - 1)];
      u[lane] = static_cast<float>(i % across) / rows->width;
      v[lane] = static_cast<float>(rows->top + i / across) / rows->height;
    }
    Color colors[kLanes];
    Trail trails[kLanes];
    trace(u, v, colors, trails);
    for (int lane = 0; lane < count; ++lane) {
      const int i = listed_[first + lane];
      if (changes != nullptr) rows->corner_changed[i] = colors[lane] != rows->corners[i];
      rows->corners[i] = colors[lane];
      rows->trails[i] = trails[lane];
    }
  }
}

// Lists the pixels whose own samples are to be traced; to others that changed goes their colour.
void TracedPicture::ListFine(Rows* rows, const PictureChanges* changes, float light, Image* image) {
  const int across = rows->width + 1;
  listed_.clear();
  for (int y = 0; y < rows->count; ++y) {
    for (int x = 0; x < rows->width; ++x) {
      const int pixel = y * rows->width + x, above = y * across + x, below = above + across;
      std::uint8_t& fine = rows->fine[pixel];
      const std::uint8_t* changed = rows->corner_changed.data();
      if (changed[above] || changed[above + 1] || changed[below] || changed[below + 1]) {
        Color color;
        if (Agree(&rows->corners[above], &rows->corners[below], alike_, &color)) {
          Put(color, light, x, rows->top + y, image);
          fine = 0;
          continue;
        }
      } else if (fine == 0) {
        continue;
      }
      const auto touched = [&](const Trail& trail) { return changes->Touches(trail); };
      const auto& trails = rows->fine_trails[pixel];
      if (fine == 0 || changes->Covers(x, rows->top + y) ||
          std::any_of(trails.begin(), trails.end(), touched)) {
        listed_.push_back(pixel);
      }
      fine = 1;
    }
  }
}

void TracedPicture::TraceFine(Rows* rows, const TraceRays& trace, float light, Image* image) {
  for (const int pixel : listed_) {
    const int x = pixel % rows->width, y = rows->top + pixel / rows->width;
    float u[kLanes], v[kLanes];
    for (int i = 0; i < kLanes; ++i) {
      u[i] = (static_cast<float>(x) + (i % 2 == 0 ? 0.25f : 0.75f)) / rows->width;
      v[i] = (static_cast<float>(y) + (i / 2 == 0 ? 0.25f : 0.75f)) / rows->height;
    }
    Color colors[kLanes];
    trace(u, v, colors, rows->fine_trails[pixel].data());
    Put((colors[0] + colors[1] + colors[2] + colors[3]) * 0.25f, light, x, y, image);
  }
}

}  // namespace prospect::sim
