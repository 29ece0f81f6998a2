#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "model/dataset.h"
#include "model/networks/networks.h"
#include "tools/tables/columns.h"

namespace prospect::tools {

/// Which part of a data set the tables are computed on, and how.
struct TableData {
  std::string path;         ///< HDF5 data set
  int every = 1;            ///< of the frames during actions, every so-many-th
  bool paper_tail = false;  ///< examples.h
  std::size_t trials = 0;   ///< at most so many test trials, evenly spread; 0 = all
  int threads = 2;
};

/// One row: sums of each test trial by its seed, and whether that trial succeeded.
struct Row {
  struct Trial {
    std::uint64_t seed = 0;
    bool succeeded = false;
    TrialSums sums;
  };
  std::vector<Trial> trials;
};

/// Rows that need no transform: what copying the picture x gives, what decode(encode(goal)) gives,
/// which is the best that T could reach, and the goal pictures as the camera saw them: their error
/// is the sensor noise, their labels say how well the judge reads real pictures.
struct Baselines {
  Row copy, reconstruction, goal;
};

/// Called after each trial, with how many of how many; one call at a time.
using ScoreProgress = std::function<void(int done, int total)>;

/// Scores T of `networks`: pictures after one and two transforms, as decoded, in the light of x.
/// `judge` reads the labels (an empty holder: nobody does). All networks in inference mode. Uses
/// data.threads threads. Throws model::DataError.
Row ScoreModel(const TableData& data, const model::Networks& networks,
               const model::Classifier& judge, const ScoreProgress& progress);

/// Scores the baselines, with encoder and decoder of `networks`.
Baselines ScoreBaselines(const TableData& data, const model::Networks& networks,
                         const model::Classifier& judge, const ScoreProgress& progress);

}  // namespace prospect::tools
