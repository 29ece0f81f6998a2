#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "model/engine.h"
#include "model/novelty_words.h"

/// Whether a picture is one that the networks know how to read: a picture unlike all that they were
/// trained on is to be refused as such, because what they say of it means nothing. No libtorch type
/// here. Functions are thread-safe.
namespace prospect::model {

/// What is compared of one picture, beside known ones.
struct NoveltySample {
  /// What the networks cannot redraw: the picture, brought to the light of its redrawing by least
  /// squares (how bright a scene is does not reach the hidden state, see LightGain), less that
  /// redrawing, f_dec(f_enc(x)); means of red, green and blue over a grid of 8 x 8 cells, 0..1.
  std::vector<float> residual;
  Hidden state;  ///< h0 = f_enc(x)
  /// Mean absolute difference of the picture in that light and its redrawing, 0..1; for people.
  double error = 0;
};

/// @param picture height x width x 3 bytes RGB
/// @param redrawn of the same size: the decoded encoding
/// Width and height must be multiples of 8.
NoveltySample CompareRedrawn(Pixels picture, const std::vector<std::uint8_t>& redrawn, int width,
                             int height, Hidden state);

/// Of a state as an engine gives it the part that tells of the picture as it is, not of its turns.
Hidden Unturned(const Hidden& state, const EngineInfo& info);

/// Encodes and redraws. Throws what the engine throws.
NoveltySample TakeNoveltySample(Engine& engine, Pixels picture);

/// Where a gauge came from; stored with it.
struct NoveltySource {
  std::uint64_t first_seed = 0;  ///< of the scenes whose first pictures it was made from
  int fitted = 0;                ///< scenes the axes were taken from
  int ranked = 0;                ///< other scenes, with which a picture is compared
  std::string command;
};

/// What is known of known pictures. Immutable.
class NoveltyGauge {
 public:
  /// From the first pictures of scenes drawn like those to come: principal axes of `fit`, ranks
  /// among `rank`. Throws std::invalid_argument if there are fewer than 16 of either or their sizes
  /// differ.
  NoveltyGauge(const std::vector<NoveltySample>& fit, const std::vector<NoveltySample>& rank);

  /// What StoreNovelty put into a weights file; nullopt where it never did. Throws WeightsError
  /// (model/weights_error.h) if the file cannot be read or what it holds is damaged.
  static std::optional<NoveltyGauge> Load(const std::string& weights_path);

  /// Split conformal prediction: of each of the two distances the share of `rank` that lies at
  /// least as far out, the picture itself among them, (1 + #{>=}) / (n + 1); p is twice the smaller
  /// one, at most 1 (Bonferroni). A picture drawn like those of `rank` gets p <= a with probability
  /// at most a. Throws std::invalid_argument on a wrong size.
  Novelty Judge(const NoveltySample& sample) const;

  /// Pictures that ranks are among.
  std::size_t ranked() const;

 private:
  struct Parts;
  explicit NoveltyGauge(std::shared_ptr<const Parts> parts) : parts_(std::move(parts)) {}
  friend void StoreNovelty(const std::string& weights_path, const NoveltyGauge& gauge,
                           const NoveltySource& source);

  std::shared_ptr<const Parts> parts_;
};

/// Rewrites the weights file with this gauge: same networks, atomically, tensors "novelty.*" and
/// the metadata's object "novelty". The weights' hash changes, since it is over the whole file.
/// Throws WeightsError.
void StoreNovelty(const std::string& weights_path, const NoveltyGauge& gauge,
                  const NoveltySource& source);

}  // namespace prospect::model
