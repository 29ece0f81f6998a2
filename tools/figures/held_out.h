#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "model/dataset.h"
#include "model/training/samples.h"
#include "sim/image.h"

namespace prospect::figures {

/// One held-out trial with the pictures at its boundaries. `samples` holds this trial alone: its
/// segments name slots, and a slot has its picture here, as the camera showed it (`seen`: what the
/// networks get) and without sensor noise (`clean`: what predictions are measured against).
struct SeenTrial {
  model::Trial labels;  ///< without images
  model::SampleSet samples;
  std::vector<sim::Image> seen, clean;

  const model::TrialSample& trial() const { return samples.trials.front(); }
  const std::vector<model::SegmentSample>& segments() const { return samples.segments; }
};

/// The test part of a data set. Reads only the trials that are asked for. One thread.
class HeldOut {
 public:
  /// Throws model::DataError if the file cannot be read or has no test trials.
  explicit HeldOut(const std::string& path);

  std::size_t size() const { return trials_.size(); }
  /// Labels of trial `k`, 0..size()-1.
  model::Trial Labels(std::size_t k) const { return file_.ReadLabels(trials_.at(k)); }
  SeenTrial Read(std::size_t k) const;

  /// All trials in an order that `seed` alone decides.
  std::vector<std::size_t> Shuffled(std::uint64_t seed) const;
  /// At most `count` trials, evenly spread.
  std::vector<std::size_t> Spread(std::size_t count) const;

 private:
  model::TrialFile file_;
  std::vector<std::size_t> trials_;  // numbers in the file
};

}  // namespace prospect::figures
