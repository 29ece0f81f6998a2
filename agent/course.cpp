#include "agent/course.h"

#include "model/surprise.h"

namespace prospect::agent {
namespace {

bool HasSize(const Picture& picture, int width, int height) {
  return !picture.empty() && picture.width == width && picture.height == height;
}

}  // namespace

std::string Course::Gap(int width, int height) const {
  for (std::size_t i = 0; i + 1 < steps_.size(); ++i) {
    if (!HasSize(steps_[i].imagined, width, height))
      return "step " + std::to_string(i + 1) + ", " + steps_[i].name;
  }
  return "";
}

double Course::SurpriseAfter(int done, const Picture& seen) const {
  if (done < 1 || static_cast<std::size_t>(done) > steps_.size()) return 0;
  const Picture& imagined = steps_[static_cast<std::size_t>(done) - 1].imagined;
  if (!HasSize(imagined, seen.width, seen.height)) return 0;
  return model::Surprise(imagined.rgb, seen.rgb, seen.width, seen.height);
}

}  // namespace prospect::agent
