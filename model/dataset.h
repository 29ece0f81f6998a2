#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/disk_error.h"
#include "model/trial.h"

/// Data sets on disk: HDF5 files in robomimic's layout (docs/architecture.md).
///
///   data                              attributes total (frames), env_args (JSON; its env_kwargs
///                                     hold world_version and successors)
///   data/demo_SEED/obs/agentview_image  uint8 [N,H,W,3], one chunk a frame, deflate
///   data/demo_SEED/obs/landmarks      float32 [N,K,2], where the recorder knows them (K > 0)
///   data/demo_SEED/actions            int32 [N,1], index into the action table, num_actions = none
///   data/demo_SEED/prev_action        int32 [N]     segment int32 [N]   rewards float32 [N]
///   data/demo_SEED/dones              uint8 [N]     present int32 [A]   segment_succeeded int8 [S]
///   data/demo_SEED                    attributes num_samples, seed, task, outcome, reason, ...,
///                                     name (only where trials have names of their own),
///                                     simulated (0 where the seed is a robot's number, else left
///                                     out)
///   /                                 attribute shard: only where it is a part of a data set, made
///                                     by collect --shard; JSON (tools/common/parts.h)
///   mask/train, mask/valid, mask/test names of the trials of each part; a trial in none of them is
///                                     in the part of its seed (SplitOf)
///
/// A collector writes one file a trial (an HDF5 file whose writer was killed does not open), and
/// packs the whole ones into one data set. libhdf5 is not thread-safe: use these functions from one
/// thread of a process at a time; several processes may read one file, and write different ones.
namespace prospect::model {

/// A data file that is missing, damaged, not ours, or a trial that breaks the rules. The message
/// names the file and says what to do.
class DataError : public ExitError {
 public:
  explicit DataError(const std::string& message) : ExitError(kExitDataFile, message) {}
};

using base::DiskError;

/// Writes a file that holds this one trial. Atomic: it is written under another name in the same
/// folder and renamed when whole, so a file of that name is always complete. An existing file is
/// replaced. Throws DataError if the trial is not valid (see ValidateTrial), DiskError if the file
/// cannot be written.
void WriteTrialFile(const std::string& path, const Trial& trial);

/// Which trials are packed: all, those of one part of the split, the first ones by seed.
struct PackChoice {
  std::optional<Split> split;
  std::size_t most = std::numeric_limits<std::size_t>::max();
  std::string shard{};  ///< what the file is a part of (TrialFile::shard); empty: it is whole
};

/// Joins the chosen trials of files (each of one or more trials) into the data set `out`, in the
/// order of their seeds, and writes the masks: the same trials give the same bytes. Image chunks
/// are copied without being unpacked. Atomic as WriteTrialFile. Returns the number of trials.
/// Throws DataError on a damaged part, on a seed that comes twice, on simulated seeds outside the
/// collection range, on trials of different tasks or image sizes, or if no trial is left, and
/// DiskError where there is no room for `out`, or another process is writing it.
std::size_t PackTrialFiles(const std::vector<std::string>& parts, const std::string& out,
                           const PackChoice& choice = {});

/// True if `path` is a whole trial file or data set that opens; never throws. For restartable
/// collectors.
bool IsWholeTrialFile(const std::string& path);

/// Reads a data set, or a file of one trial. Movable, not copyable; holds the file open. Not
/// thread-safe.
class TrialFile {
 public:
  /// Opens `path` read-only. Throws DataError.
  explicit TrialFile(const std::string& path);
  ~TrialFile();
  TrialFile(TrialFile&&) noexcept;
  TrialFile& operator=(TrialFile&&) noexcept;

  const std::string& path() const;
  std::size_t size() const;                         ///< number of trials
  const std::vector<std::uint64_t>& seeds() const;  ///< ascending; trial i has seeds()[i]

  /// What `collect --shard` says of the run that this file is a part of; empty: it is no part.
  std::string shard() const;
  /// The part that trial `i` (0..size()-1) is in.
  Split part(std::size_t i) const;
  /// Trial `i` (0..size()-1) with its clean images. Throws DataError if it is damaged.
  Trial Read(std::size_t i) const;
  /// Trial `i` without images (`images` empty): labels and attributes only.
  Trial ReadLabels(std::size_t i) const;
  /// The chosen clean frames of trial `i`, one after another into `out`
  /// (frames.size() x height x width x 3 bytes). Throws DataError, also on a frame out of range.
  void ReadFrames(std::size_t i, const std::vector<int>& frames, std::uint8_t* out) const;

  /// A hash of what the file holds as far as training depends on it: seeds, labels, attributes and
  /// image sizes (not the pixels themselves, which would take minutes). Hexadecimal text.
  std::string ContentHash() const;

  /// A hash of the first frames of up to 64 trials, evenly spread: another camera or encoder shows
  /// in it although labels are the same. Hexadecimal text. Throws DataError as ReadFrames.
  std::string PicturesHash() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// What `prospect dataset info` shows.
struct DataSetSummary {
  std::size_t trials = 0;
  std::size_t successes = 0;
  std::vector<std::pair<std::string, std::size_t>> failures;  ///< by reason, most frequent first
  std::size_t frames = 0;
  std::size_t segments = 0;
  std::size_t segments_succeeded = 0;
  std::size_t train = 0, valid = 0, test = 0;  ///< trials of each part
  std::string task;
  std::string world_version;
  std::string shard;  ///< TrialFile::shard()
  int width = 0, height = 0, num_actions = 0;
};

/// Reads all labels of the file (no images) and counts. Throws DataError.
DataSetSummary Summarize(const TrialFile& file);

}  // namespace prospect::model
