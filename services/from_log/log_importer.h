#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "model/trial.h"
#include "services/from_log/event_log.h"
#include "services/from_log/recorded_run.h"

namespace prospect::services {

/// What became of one recorded run.
struct ImportRow {
  std::int64_t episode_id = 0;
  std::int64_t frames = 0;  ///< of the trial; of a refused run, the different pictures in the log
  std::string outcome;      ///< "success", "failure" or "refused"
  std::string reason;       ///< of the failure or the refusal
};

/// Turns the events of logs into trials, one run at a time, so that a log of any length needs the
/// memory of two runs. A run is one pass through one scene: another episode, or one that begins
/// again at frame 0, is another run, and of several runs of one scene (one seed of LABEL) the first
/// whole one is kept, since data sets hold a seed once. Feed events in the order of the log. Not
/// thread-safe.
class LogImporter {
 public:
  /// Takes a finished trial. May throw model::DataError to refuse it by its own rules (a seed kept
  /// for evaluation, say).
  using Sink = std::function<void(const model::Trial&)>;

  explicit LogImporter(Sink sink) : sink_(std::move(sink)) {}

  /// Takes one event; channels that do not matter are skipped.
  void Take(const LogEvent& event);

  /// Finishes what is open: call at the end of each log, because runs do not go on in another.
  void EndOfLog();

  const std::vector<ImportRow>& rows() const { return rows_; }
  /// Events that were refused, by "CHANNEL: reason".
  const std::map<std::string, std::int64_t>& refused() const { return refused_; }

 private:
  template <class T>
  std::optional<T> Decode(const LogEvent& event);
  template <class T>
  void TakeFrame(const LogEvent& event);
  template <class T>
  void TakeWord(const LogEvent& event);
  RecordedRun& RunOf(std::int64_t episode_id, std::int64_t frame);
  void Finish(RecordedRun& run);
  ImportRow Import(RecordedRun& run);

  Sink sink_;
  // The run that is being recorded, and the one before it, whose last label may still be on its
  // way.
  std::unique_ptr<RecordedRun> current_;
  std::unique_ptr<RecordedRun> previous_;
  std::shared_ptr<const task_t> task_;
  std::set<std::uint64_t> numbers_;  // of the trials that were kept
  std::vector<ImportRow> rows_;
  std::map<std::string, std::int64_t> refused_;
};

}  // namespace prospect::services
