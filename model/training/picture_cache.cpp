#include "model/training/picture_cache.h"

#include <atomic>
#include <cstring>
#include <mutex>

#include "base/sensor_noise.h"
#include "model/training/parallel.h"
#include "model/training/views.h"

namespace prospect::model {
namespace {

constexpr std::int64_t kEncodeBatch = 32;
constexpr std::size_t kMeanFrames = 2000;

std::size_t FrameBytes(const SampleSet& set) {
  return static_cast<std::size_t>(set.width) * static_cast<std::size_t>(set.height) * 3;
}

/// Frames of one trial lie one after another in SampleSet::frames; this reads them with one visit
/// to the file.
void ReadTrialFrames(const TrialFile& file, const SampleSet& set, std::size_t first_slot,
                     std::size_t end_slot, std::uint8_t* out) {
  const TrialSample& trial = set.trials[static_cast<std::size_t>(set.frames[first_slot].trial)];
  std::vector<int> frames;
  for (std::size_t s = first_slot; s < end_slot; ++s) frames.push_back(set.frames[s].frame);
  file.ReadFrames(trial.index, frames, out);
  const double sigma = file.ReadLabels(trial.index).image_noise;
  for (std::size_t k = 0; k < frames.size(); ++k) {
    base::AddSensorNoise(out + k * FrameBytes(set), FrameBytes(set), trial.seed, frames[k], sigma);
  }
}

void ReadAllFrames(const TrialFile& file, const SampleSet& set, std::uint8_t* out,
                   const ProgressFn& progress) {
  for (std::size_t first = 0, end = 0; first < set.frames.size(); first = end) {
    while (end < set.frames.size() && set.frames[end].trial == set.frames[first].trial) ++end;
    ReadTrialFrames(file, set, first, end, out + first * FrameBytes(set));
    progress(static_cast<std::int64_t>(end), static_cast<std::int64_t>(set.frames.size()));
  }
}

std::vector<int> Range(std::int64_t begin, std::int64_t end) {
  std::vector<int> values;
  for (std::int64_t i = begin; i < end; ++i) values.push_back(static_cast<int>(i));
  return values;
}

}  // namespace

PictureCache::PictureCache(const std::string& path, const TrialFile& file, const SampleSet& set,
                           const ProgressFn& progress)
    : width_(set.width),
      height_(set.height),
      file_(path, set.frames.size() * FrameBytes(set), [&](void* out) {
        ReadAllFrames(file, set, static_cast<std::uint8_t*>(out), progress);
      }) {}

torch::Tensor PictureCache::Get(const std::vector<int>& slots) const {
  const auto bytes = static_cast<std::size_t>(width_ * height_ * 3);
  torch::Tensor raw =
      torch::empty({static_cast<int64_t>(slots.size()), height_, width_, 3}, torch::kUInt8);
  for (std::size_t i = 0; i < slots.size(); ++i) {
    std::memcpy(
        raw.data_ptr<std::uint8_t>() + i * bytes,
        static_cast<const std::uint8_t*>(file_.data()) + static_cast<std::size_t>(slots[i]) * bytes,
        bytes);
  }
  return raw.permute({0, 3, 1, 2}).contiguous().to(torch::kFloat).div_(255.0F);
}

torch::Tensor PictureCache::Mean(const std::vector<int>& slots) const {
  const std::size_t step = std::max<std::size_t>(1, slots.size() / kMeanFrames);
  torch::Tensor sum = torch::zeros({3, height_, width_});
  std::int64_t count = 0;
  for (std::size_t i = 0; i < slots.size(); i += step, ++count) sum += Get({slots[i]})[0];
  return sum / static_cast<double>(std::max<std::int64_t>(1, count));
}

HiddenCache::HiddenCache(const std::string& path, const PictureCache& pictures, std::size_t slots,
                         int variants, const ViewFn& view, Encoder encoder,
                         const NetworkConfig& config, int threads, const torch::Device& device,
                         const ProgressFn& progress)
    : config_(config),
      slots_(slots),
      variants_(variants),
      file_(path, slots * static_cast<std::size_t>(variants * config.hidden_size()) * sizeof(float),
            [&](void* out) {
              encoder->eval();
              std::mutex mutex;
              std::int64_t done = 0;  // guarded by mutex
              const auto total = static_cast<std::int64_t>(slots) * variants;
              const auto encode = [&](std::int64_t begin, std::int64_t end, int variant) {
                const torch::NoGradGuard no_grad;
                const std::vector<int> range = Range(begin, end);
                std::vector<int> views;
                for (const int slot : range) views.push_back(view(slot, variant));
                const torch::Tensor x = View(pictures.Get(range), views).to(device);
                const torch::Tensor h = encoder->forward(x).to(torch::kCPU).contiguous();
                const std::size_t row =
                    static_cast<std::size_t>(variant) * slots + static_cast<std::size_t>(begin);
                std::memcpy(
                    static_cast<float*>(out) + row * static_cast<std::size_t>(config.hidden_size()),
                    h.data_ptr<float>(), h.nbytes());
                const std::lock_guard<std::mutex> lock(mutex);
                progress(done += end - begin, total);
              };
              for (int v = 0; v < variants; ++v) {
                ParallelPieces(
                    static_cast<std::int64_t>(slots), kEncodeBatch, device.is_cpu() ? threads : 1,
                    [&](std::int64_t begin, std::int64_t end) { encode(begin, end, v); });
              }
            }) {}

torch::Tensor HiddenCache::Get(const std::vector<int>& slots,
                               const std::vector<int>& variants) const {
  const auto size = static_cast<std::size_t>(config_.hidden_size());
  torch::Tensor h = torch::empty({static_cast<int64_t>(slots.size()), config_.hidden_channels,
                                  config_.hidden_height(), config_.hidden_width()});
  for (std::size_t i = 0; i < slots.size(); ++i) {
    const std::size_t row =
        static_cast<std::size_t>(variants[i]) * slots_ + static_cast<std::size_t>(slots[i]);
    std::memcpy(h.data_ptr<float>() + i * size,
                static_cast<const float*>(file_.data()) + row * size, size * sizeof(float));
  }
  return h;
}

}  // namespace prospect::model
