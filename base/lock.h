#pragma once

#include <string>

#include "base/disk_error.h"

namespace prospect::base {

/// Somebody else is using a file or folder; the message names both.
class InUseError : public DiskError {
 public:
  using DiskError::DiskError;
};

/// A file or folder that is used by one process at a time. It is locked itself (flock), so that
/// nothing is left behind, and the kernel takes the lock away when its holder ends, however it
/// ends; children that were forked meanwhile hold it, too. Only those who ask for the lock heed it.
/// On file systems that know no locks everybody gets it. Movable.
class Lock {
 public:
  /// Takes `path`, which is there, or throws InUseError at once; DiskError if it cannot be opened.
  explicit Lock(const std::string& path);
  Lock(Lock&& other) noexcept;
  Lock& operator=(Lock&& other) noexcept;
  ~Lock();

 private:
  int file_;
};

/// Makes the folder where it is missing, and locks it.
Lock LockFolder(const std::string& path);

/// Whether an open file could be locked, or needs no lock since its file system knows none.
bool TryLock(int file);

/// Who holds the lock on an open file, such as "prospect-train train --task stacking (pid 4711)";
/// where that cannot be seen, "another process".
std::string HolderOf(int file);

/// What InUseError says of `path`, whose open file is locked by somebody else.
std::string InUseWords(const std::string& path, int file);

}  // namespace prospect::base
