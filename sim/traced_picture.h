#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "sim/image.h"
#include "sim/mesh.h"
#include "sim/picture_changes.h"

namespace prospect::sim {

inline constexpr int kLanes = 4;  // rays traced together

// The colours that rays through kLanes places of a picture meet, and how they went: u to the right,
// v down, 0 to 1. What a ray meets must not depend on the others.
using TraceRays = std::function<void(const float u[kLanes], const float v[kLanes],
                                     Color colors[kLanes], Trail trails[kLanes])>;

// Throws std::invalid_argument unless width and height are 1 to 4096.
void CheckPictureSize(int width, int height);

// Whether a TracedPicture of that size is kept: larger ones take too much memory.
bool KeepsPicture(int width, int height);

// Pictures of one view after another. A pixel is the mean of its corners where these differ by less
// than `alike` (0 to 1) in each channel, and of 2 x 2 samples of its own elsewhere: edges are
// smooth at little more than a ray a pixel. Of a small picture, rays that nothing touched since the
// one before are not traced again; it is the same to the bit as if all were.
//
// Threads: one at a time per object.
class TracedPicture {
 public:
  explicit TracedPicture(float alike) : alike_(alike) {}

  // The next picture in a light scaled by `light`: with `changes` of the same size, view and light
  // as before unless they say everything; without, one that is not kept.
  Image Render(int width, int height, double light, const PictureChanges* changes,
               const TraceRays& trace);

 private:
  // Rows of a picture and what is kept of them.
  struct Rows {
    int width = 0, height = 0;  // of the picture
    int top = 0, count = 0;
    std::vector<Color> corners;  // (width + 1) * (count + 1), as their trails
    std::vector<Trail> trails;
    std::vector<std::uint8_t> corner_changed;
    std::vector<std::uint8_t> fine;                      // pixels that have samples of their own
    std::vector<std::array<Trail, kLanes>> fine_trails;  // of these
  };

  void Begin(int width, int height, int top, int count, Rows* rows) const;
  void Update(Rows* rows, const PictureChanges* changes, const TraceRays& trace, float light,
              Image* image);
  void TraceCorners(Rows* rows, const PictureChanges* changes, const TraceRays& trace);
  void ListFine(Rows* rows, const PictureChanges* changes, float light, Image* image);
  void TraceFine(Rows* rows, const TraceRays& trace, float light, Image* image);

  float alike_;
  Rows kept_;
  Image image_;              // that belongs to kept_
  std::vector<int> listed_;  // corners, then pixels, of rows that are to be traced
};

}  // namespace prospect::sim
