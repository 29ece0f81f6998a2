#pragma once

#include <memory>
#include <set>
#include <string>
#include <vector>

#include "model/training/context.h"

namespace prospect::model {

/// How a training run is asked for.
struct TrainOptions {
  std::string task;
  std::string data;  ///< an HDF5 data set (model/dataset.h)
  /// DIR: stages (each under a name that says what it was trained from, so that variants share
  /// what they have in common), caches; the weights and curves.csv, without a variant.
  std::string folder;
  std::string variant;  ///< weights and curves.csv go to DIR/VARIANT; empty = to DIR
  std::string from;     ///< a weights file to begin from; empty = from random weights
  /// Stages (names as below) whose networks begin from random weights all the same: variants are
  /// compared on one encoder.
  std::set<std::string> fresh;
  std::string device = "cpu";
  int threads = 2;
  /// Names of the stages to run, empty = all: classifier, second-classifier, encoder-decoder,
  /// transform, heads.
  std::set<std::string> stages;
  bool score_only = false;  ///< nothing is trained: the data set need only have test trials
  /// Of all stages' iterations together; 0: as many iterations as the configuration says. Stages
  /// that it leaves out stay out.
  double minutes = 0;
  std::string command;  ///< kept in the metadata: how the weights were made
};

/// One stage of a run, for tables.
struct StageSummary {
  std::string name;
  std::int64_t iterations = 0;
  int batch = 0;
  double seconds = 0;  ///< StageOutcome::seconds
};

/// The training order (docs/training.md): C, a second classifier, encoder and decoder, T, then V,
/// Q, p, f. Each stage resumes from its checkpoint, and is skipped when it was already trained from
/// the same inputs. One object one run; not thread-safe. It uses `threads` threads inside.
class Trainer {
 public:
  /// Reads labels and builds the picture cache. The folder is the caller's to lock: another process
  /// would write the same checkpoints. Throws DataError, WeightsError, std::invalid_argument.
  Trainer(const TrainConfig& config, const TrainOptions& options);
  ~Trainer();

  /// Trains what is asked for; throws as RunStage does.
  void Run();

  /// Instead of Run: takes all networks from a weights file TASK.safetensors and the
  /// TASK-classifiers.safetensors beside it (export.h). Throws WeightsError.
  void Load(const std::string& weights);

  /// After Run or Load: the networks in inference mode, and what they were trained on.
  const TrainContext& context() const;
  const TrialFile& file() const;
  /// Hash of labels and configuration that everything depends on.
  const std::string& data_hash() const;
  const TrainOptions& options() const;
  /// Where weights and curves go; made by the constructor.
  std::string weights_folder() const;
  /// What Run went through, in order.
  const std::vector<StageSummary>& stages() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace prospect::model
