#include "base/sensor_noise.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/random.h"

namespace prospect::base {
namespace {

constexpr int kLevels = 1 << 16;

// The offset in grey levels for each of 65,536 equally likely draws: the Gaussian's quantiles,
// rounded. Because pixels are integers, rounding the offset equals rounding the sum.
class OffsetTable {
 public:
  explicit OffsetTable(double sigma) : sigma_(sigma), offsets_(kLevels) {
    const double scale = sigma * 255.0;
    int offset = static_cast<int>(-4.5 * scale) - 1;
    for (int i = 0; i < kLevels; ++i) {
      const double share = (i + 0.5) / kLevels;
      while (CumulativeShare((offset + 0.5) / scale) < share) ++offset;
      offsets_[i] = static_cast<std::int16_t>(offset);
    }
  }

  double sigma() const { return sigma_; }
  int operator[](std::size_t i) const { return offsets_[i]; }

 private:
  static double CumulativeShare(double z) { return 0.5 * std::erfc(-z / std::sqrt(2.0)); }

  double sigma_;
  std::vector<std::int16_t> offsets_;
};

// Tables are kept by thread: no lock in the hot path, and few sigmas are ever in use.
const OffsetTable& TableFor(double sigma) {
  thread_local std::vector<OffsetTable> tables;
  for (const OffsetTable& table : tables) {
    if (table.sigma() == sigma) return table;
  }
  if (tables.size() > 8) tables.clear();
  tables.emplace_back(sigma);
  return tables.back();
}

std::uint8_t Clamped(int value) { return static_cast<std::uint8_t>(std::clamp(value, 0, 255)); }

}  // namespace

void AddSensorNoise(std::uint8_t* rgb, std::size_t n, std::uint64_t trial_seed, std::int64_t frame,
                    double sigma) {
  if (!(sigma >= 0.0 && sigma <= 0.25)) {
    throw std::invalid_argument("sensor noise sigma is " + std::to_string(sigma) +
                                ": give a share of full range from 0 to 0.25");
  }
  if (sigma == 0.0) return;
  const OffsetTable& table = TableFor(sigma);
  const std::uint64_t key =
      MixSeeds({trial_seed, static_cast<std::uint64_t>(frame), 0x6e6f697365ULL});
  for (std::size_t i = 0; i < n; i += 4) {  // four 16-bit draws a hash
    std::uint64_t draws = Mix64(key + i);
    const std::size_t end = std::min(n, i + 4);
    for (std::size_t j = i; j < end; ++j, draws >>= 16) {
      rgb[j] = Clamped(rgb[j] + table[draws & 0xffff]);
    }
  }
}

}  // namespace prospect::base
