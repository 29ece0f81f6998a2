#include "tools/figures/held_out.h"

#include <algorithm>
#include <numeric>

#include "base/random.h"
#include "base/sensor_noise.h"

namespace prospect::figures {

HeldOut::HeldOut(const std::string& path) : file_(path) {
  for (std::size_t i = 0; i < file_.size(); ++i) {
    if (file_.part(i) == model::Split::kTest) trials_.push_back(i);
  }
  if (trials_.empty()) {
    throw model::DataError(path + ": has no test trials (a tenth of the seeds, by their hash); " +
                           "collect more trials");
  }
}

SeenTrial HeldOut::Read(std::size_t k) const {
  const std::size_t number = trials_.at(k);
  SeenTrial trial;
  trial.labels = file_.ReadLabels(number);
  model::AddTrial(trial.labels, number, /*mids_per_segment=*/0, &trial.samples);
  std::vector<int> frames;
  for (const model::FrameRef& frame : trial.samples.frames) frames.push_back(frame.frame);
  const std::size_t bytes = trial.labels.frame_bytes();
  std::vector<std::uint8_t> pixels(frames.size() * bytes);
  file_.ReadFrames(number, frames, pixels.data());
  for (std::size_t i = 0; i < frames.size(); ++i) {
    sim::Image picture{trial.labels.width, trial.labels.height, {}};
    picture.rgb.assign(pixels.begin() + static_cast<std::ptrdiff_t>(i * bytes),
                       pixels.begin() + static_cast<std::ptrdiff_t>((i + 1) * bytes));
    trial.clean.push_back(picture);
    base::AddSensorNoise(picture.rgb.data(), bytes, trial.labels.seed, frames[i],
                         trial.labels.image_noise);
    trial.seen.push_back(std::move(picture));
  }
  return trial;
}

std::vector<std::size_t> HeldOut::Shuffled(std::uint64_t seed) const {
  std::vector<std::size_t> order(size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  base::Random random(seed);
  for (std::size_t i = order.size(); i > 1; --i) {
    std::swap(order[i - 1], order[static_cast<std::size_t>(random.Below(static_cast<int>(i)))]);
  }
  return order;
}

std::vector<std::size_t> HeldOut::Spread(std::size_t count) const {
  std::vector<std::size_t> chosen;
  const std::size_t taken = std::min(count, size());
  for (std::size_t i = 0; i < taken; ++i) chosen.push_back(i * size() / taken);
  return chosen;
}

}  // namespace prospect::figures
