#pragma once

#include <cstring>
#include <stdexcept>
#include <string>

namespace prospect::base {

/// A file or folder cannot be written: the disk is full, the folder is missing or read-only, or
/// somebody else is using it. The message names it and says why. Programs end with exit code 13.
class DiskError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Throws DiskError for `path` with the reason `error`, a value of errno.
[[noreturn]] inline void FailToWrite(const std::string& path, int error) {
  throw DiskError(path + ": cannot be written (" + std::strerror(error) +
                  "); check the folder and the space on the disk");
}

}  // namespace prospect::base
