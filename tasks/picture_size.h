#pragma once

#include <string>

namespace prospect::tasks {

/// What to know of pictures so large that LCM sends each in several datagrams, for people; empty:
/// they are not. @param width,height pixels, of three bytes
std::string PictureSizeRemark(int width, int height);

}  // namespace prospect::tasks
