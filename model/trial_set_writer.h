#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "model/trial.h"

namespace prospect::model {

/// Writes a data set (model/dataset.h) trial by trial and frame by frame, in memory that grows with
/// neither: for sources such as videos that are read as a stream.
///
///   TrialSetWriter writer(path);
///   writer.Begin(trial);            // sizes, seed
///   writer.AddFrame(rgb);           // any number of times
///   writer.End(trial);              // its labels, one a frame added
///   ...
///   writer.Commit();
///
/// Whatever goes wrong before Commit(), nothing remains on disk. One thread; no other HDF5 work in
/// this process between two calls on another thread.
class TrialSetWriter {
 public:
  /// Throws DiskError.
  explicit TrialSetWriter(const std::string& path);
  ~TrialSetWriter();
  TrialSetWriter(const TrialSetWriter&) = delete;
  TrialSetWriter& operator=(const TrialSetWriter&) = delete;

  /// Begins a trial of `shape`'s seed and picture size, of `most_frames` frames at most. Throws
  /// DataError on a seed that was written already, DiskError where there is no room for it.
  void Begin(const Trial& shape, int most_frames);
  /// The trial's next picture, height x width x 3 bytes. Throws DataError beyond `most_frames`.
  void AddFrame(const std::uint8_t* rgb);
  /// Ends the trial: `labels` is all of it but the images. Throws DataError if it is not valid
  /// (ValidateTrial), has not one label a frame added, or is of another kind than the first.
  void End(const Trial& labels);
  /// Forgets the trial that was begun.
  void Drop();
  /// Trials ended so far.
  std::size_t size() const;
  /// Writes the masks and gives the file its name. `parts` says where trials belong, by seed; those
  /// it does not name are in the part of their labels. Throws DataError without a trial, DiskError.
  void Commit(const std::map<std::uint64_t, Split>& parts = {});

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace prospect::model
