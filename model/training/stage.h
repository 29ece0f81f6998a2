#pragma once

#include <torch/torch.h>

#include <string>
#include <vector>

#include "model/training/train_config.h"

namespace prospect::model {

/// What one shard of one batch gives: the loss to minimise and its named parts for the curves.
struct LossParts {
  torch::Tensor loss;                                 ///< scalar
  std::vector<std::pair<std::string, double>> parts;  ///< same names every time
};

/// One step of the training order: some networks, a loss, a number of iterations.
class Stage {
 public:
  virtual ~Stage() = default;
  virtual std::string name() const = 0;
  virtual const StageConfig& config() const = 0;
  /// The networks it trains, with the names they have in checkpoints.
  virtual std::vector<std::pair<std::string, torch::nn::Module*>> modules() const = 0;
  /// Shard `shard` of `shards` of batch `iteration`: a pure function of these numbers, the weights
  /// and the data. Called from several threads at once for different shards; dropout is seeded by
  /// the caller.
  virtual LossParts Loss(std::int64_t iteration, int shard, int shards) = 0;

  /// "adam" or "rmsprop".
  virtual std::string optimizer() const { return "adam"; }
  /// The learning rate of one of modules(), as a multiple of the configuration's.
  virtual double RateOf(const std::string& /*module*/) const { return 1.0; }
  /// After every step of the optimizer.
  virtual void AfterStep() {}
};

/// Where and how a stage runs.
struct StageRun {
  std::string folder;  ///< DIR: checkpoints, finished stages, curves.csv
  std::string key;     ///< hash of everything the result depends on
  std::uint64_t seed = 1;
  int shards = 2;
  int threads = 2;
  bool mixed_precision = false;  ///< model/networks/precision.h
  bool quiet = false;            ///< no progress on stderr
  double checkpoint_seconds = 60;
  torch::Device device = torch::kCPU;
  /// To try how fast it is, and for tests: stop (as if killed) after this many; -1 = never.
  std::int64_t stop_after = -1;
};

/// How a stage went.
struct StageOutcome {
  bool finished = false;
  double seconds = 0;  ///< spent on its iterations, in all runs that it took; 0 if not known
};

/// Runs a stage to its end, or continues it from its checkpoint, or loads its result if `run.key`
/// is already finished. The result is the same in all three cases (same machine, same shards).
/// Writes DIR/stage-NAME.pt when finished, DIR/stage-NAME.checkpoint every `checkpoint_seconds`,
/// and rows to DIR/curves.csv; progress with an estimate of the time left goes to stderr. Not
/// finished only if `stop_after` ended it early. Throws base::DiskError if a file cannot be
/// written (then it goes on from the last checkpoint when asked again), ExitError
/// (kExitTaskFailure) if the loss stops being a number.
StageOutcome RunStage(Stage* stage, const StageRun& run);

/// Only loads the finished result of `run.key`, into inference mode; not finished if there is none.
StageOutcome LoadFinished(Stage* stage, const StageRun& run);

}  // namespace prospect::model
