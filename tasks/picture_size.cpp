#include "tasks/picture_size.h"

namespace prospect::tasks {

std::string PictureSizeRemark(int width, int height) {
  constexpr int kDatagramBytes = 65'000;
  const int bytes = width * height * 3;
  if (bytes <= kDatagramBytes) return "";
  return "a picture has " + std::to_string(bytes / 1000) +
         " kB and goes in several datagrams, of which LCM loses a picture on a network that "
         "changes their order: robot and planner on one machine, or at most 144x144";
}

}  // namespace prospect::tasks
