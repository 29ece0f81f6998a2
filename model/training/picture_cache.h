#pragma once

#include <torch/torch.h>

#include <functional>
#include <string>

#include "model/networks/encoder.h"
#include "model/training/mapped_file.h"
#include "model/training/samples.h"

namespace prospect::model {

/// Progress of a long loop: units done, of how many. Called from one thread at a time.
using ProgressFn = std::function<void(std::int64_t done, std::int64_t total)>;

/// How a variant of a slot's picture is varied (model/training/views.h). Called from several
/// threads.
using ViewFn = std::function<int(int slot, int variant)>;

/// All frames of a SampleSet as they are seen, sensor noise included, by slot. Memory-mapped;
/// reading is thread-safe.
class PictureCache {
 public:
  /// Reads the frames of `set` from `file` unless `path` already holds them. Throws DataError.
  PictureCache(const std::string& path, const TrialFile& file, const SampleSet& set,
               const ProgressFn& progress);
  /// Pictures of the slots as [B,3,H,W] floats in [0,1] (on the CPU).
  torch::Tensor Get(const std::vector<int>& slots) const;
  /// Mean picture [3,H,W] of (up to 2,000 of) the slots given.
  torch::Tensor Mean(const std::vector<int>& slots) const;

 private:
  int width_, height_;
  MappedFile file_;
};

/// Encodings of all frames by (variant, slot), in 32-bit floats. Memory-mapped; reading is
/// thread-safe.
class HiddenCache {
 public:
  /// Encodes every frame with `encoder` (put into inference mode) unless `path` already holds them.
  /// Variant v of a slot is its picture varied: View(picture, view(slot, v)).
  HiddenCache(const std::string& path, const PictureCache& pictures, std::size_t slots,
              int variants, const ViewFn& view, Encoder encoder, const NetworkConfig& config,
              int threads, const torch::Device& device, const ProgressFn& progress);
  /// Hidden states [B,c,Hh,Wh] (on the CPU); variants[i] belongs to slots[i].
  torch::Tensor Get(const std::vector<int>& slots, const std::vector<int>& variants) const;
  int variants() const { return variants_; }

 private:
  NetworkConfig config_;
  std::size_t slots_;
  int variants_;
  MappedFile file_;
};

}  // namespace prospect::model
