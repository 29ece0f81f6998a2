#pragma once

#include <cstring>
#include <string>

#include "base/exit_error.h"

namespace prospect::base {

/// A file or folder cannot be written: the disk is full, the folder is missing or read-only, or
/// somebody else is using it. The message names it and says why.
class DiskError : public ExitError {
 public:
  explicit DiskError(const std::string& message) : ExitError(kExitDisk, message) {}
};

/// Throws DiskError for `path` with the reason `error`, a value of errno.
[[noreturn]] inline void FailToWrite(const std::string& path, int error) {
  throw DiskError(path + ": cannot be written (" + std::strerror(error) +
                  "); check the folder and the space on the disk");
}

}  // namespace prospect::base
