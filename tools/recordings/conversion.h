#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "model/segments/hold_out.h"
#include "model/segments/segmentation.h"
#include "model/trial_set_writer.h"
#include "tasks/task_file.h"

namespace prospect::tools {

// Pictures in the order in which they were taken, read once.
class Pictures {
 public:
  virtual ~Pictures() = default;
  // Goes on by one. False at the end, or where the recording is damaged.
  virtual bool Next() = 0;
  // The present one as width x height x 3 bytes RGB. False if it is damaged.
  virtual bool Get(int width, int height, std::vector<std::uint8_t>* rgb) = 0;
};

// A recorded trial: how it is called, and what is said of its pictures.
struct Recording {
  std::string name;
  std::uint64_t number = 0;
  std::string world_version;  // what was recorded, as data sets and weights keep it
  std::string path;           // of the file that says which actions ran
  model::segments::Segmentation segmentation;
  int every = 1;            // one frame in so many is kept (model::segments::KeptFrames)
  double tick_seconds = 0;  // between two that are kept
  bool before = true;       // a frame before the first action is kept, too: nothing is done in it
  std::optional<model::Split> part;  // nothing: by a hash of its name
};

struct ConversionReport {
  std::size_t trials = 0, repaired = 0, left_out = 0;
  std::int64_t frames = 0;
};

// Recordings of a task to one data set, trial by trial, in memory that does not grow. Lines for a
// person go to `say`. One thread.
class Conversion {
 public:
  using Say = std::function<void(const std::string&)>;
  // All must outlive the object. Throws model::DiskError where `out` cannot be written.
  Conversion(const tasks::TaskFile& task, const std::string& out, const Say& say,
             const std::atomic<bool>* stop);

  std::vector<std::string> action_names() const;

  // Calls `take`, which calls Take(). What it throws as model::DataError is said, and the trial
  // left out.
  void Try(const std::string& name, const std::function<void()>& take);
  // Adds a trial; what was repaired is said. Throws model::DataError: it cannot be used;
  // Interrupted (base/exit_error.h) once `*stop` is set.
  void Take(Recording recording, Pictures* pictures);

  // Gives the data set its name. Throws model::DataError if no trial was taken, DiskError,
  // std::invalid_argument as model::segments::AssignParts does.
  ConversionReport Finish(const std::string& source, const std::vector<std::string>& held_out);

 private:
  model::Trial Shape(const Recording& recording) const;
  std::vector<int> CopyFrames(Recording* recording, Pictures* pictures);
  void RequireWhole(const Recording& recording) const;
  int PlanLength(int actions) const;

  const tasks::TaskFile& task_;
  const Say& say_;
  const std::atomic<bool>* stop_;
  model::TrialSetWriter writer_;
  model::segments::NamedTrials done_;
  std::map<std::uint64_t, model::Split> parts_;
  ConversionReport report_;
};

}  // namespace prospect::tools
