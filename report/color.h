#pragma once

#include <cstdint>

namespace prospect::report {

/// 8 bits a channel.
struct Color {
  std::uint8_t r = 0, g = 0, b = 0;
};

inline constexpr Color kPaper{255, 255, 255};
inline constexpr Color kInk{35, 35, 40};
inline constexpr Color kFaint{105, 105, 112};
inline constexpr Color kRule{208, 208, 212};
inline constexpr Color kPale{236, 236, 240};
inline constexpr Color kBad{200, 40, 40};
inline constexpr Color kGood{30, 130, 60};
inline constexpr Color kDoubt{178, 86, 0};  ///< refused, or not as usual
inline constexpr Color kMark{30, 90, 180};  ///< what was measured or imagined

/// A colour for 0..1 whose lightness grows evenly from dark blue to yellow (the map known as
/// viridis), so that it reads in grey, too. Values outside are cut to 0..1.
Color HeatColor(double share);

}  // namespace prospect::report
