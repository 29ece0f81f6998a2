#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "base/destination.h"
#include "base/disk_error.h"

namespace prospect::base {

/// Who else may be writing the same file.
enum class Rivals {
  kAllowed,  ///< the last one to finish counts
  kRefused,  ///< InUseError where another process is writing it
};

/// A file that is written under another name in the same folder and takes its own in Commit():
/// a reader never sees half of it, and without Commit() nothing of it remains. Only a plain file or
/// a new name is ever renamed over, and the plain file's mode is kept. A link is followed to what
/// it points at. A device, pipe or terminal stays what it is: Commit() copies into it what was
/// written.
///
/// The other name is hidden and keeps the ending (".trials.part.h5"). Its file is locked while it
/// is written: another writer of the same file takes another name, and what a killed one left
/// behind is used again by the next. One thread. All functions throw DiskError.
class AtomicFile {
 public:
  explicit AtomicFile(const std::string& path, Rivals rivals = Rivals::kAllowed);
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  ~AtomicFile();

  /// Where to write until Commit(): an empty plain file, for libraries that want a path.
  const std::string& temporary() const { return temporary_; }
  /// The same file, open for reading and writing; it stays the object's own.
  int descriptor() const { return file_; }

  /// Appends to what was written so far, for those who need no library.
  void Write(std::string_view bytes) const;
  /// Takes the disk space of the first `bytes` of the file, because libhdf5 crashes when it gives
  /// out under its hands. Does nothing on a file system that cannot reserve.
  void Reserve(std::uintmax_t bytes) const;
  /// Gives back what Reserve() took too much.
  void Trim() const;
  /// Puts the file on the disk and gives it its name. At most once.
  void Commit();

 private:
  void OpenBeside(Rivals rivals);
  void OpenElsewhere();
  void KeepMode() const;

  std::string path_;  // as it was given, for messages
  Destination to_;
  std::string temporary_;
  int file_ = -1;
};

/// Writes a whole file as AtomicFile does. Throws DiskError.
void WriteFile(const std::string& path, std::string_view bytes);

}  // namespace prospect::base
