#pragma once

namespace prospect::tools {

/// What our MP4 files hold, as OpenCV names it ("avc1"): H.264, which browsers play; MPEG-4 Part 2
/// ("mp4v") they do not.
constexpr int kVideoCodec = 'a' | 'v' << 8 | 'c' << 16 | '1' << 24;

}  // namespace prospect::tools
