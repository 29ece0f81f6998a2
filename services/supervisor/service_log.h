#pragma once

#include <sys/types.h>

#include <cstdint>
#include <string>

#include "base/descriptor.h"

namespace prospect::services {

/// The log of one service. The service prints into a pipe, whichever of its libraries it is that
/// prints, and this writes it to a file: so the file can be rotated while the service runs, its
/// folder made again when it was removed, and a disk that is full ends nobody. A service that
/// prints faster than the disk takes it waits.
///
/// Of NAME.log at most `max_bytes` are kept, and as many before them in NAME.1.log. One thread,
/// which must call Drain() whenever output() can be read.
class ServiceLog {
 public:
  static constexpr std::int64_t kMaxBytes = 10'000'000;

  /// Begins the file anew. @throws ExitError (kExitDisk) when it cannot be written,
  /// std::runtime_error when there can be no pipe
  explicit ServiceLog(std::string path, std::int64_t max_bytes = kMaxBytes);

  /// Where the service prints to.
  int input() const { return input_.get(); }
  /// What to poll.
  int output() const { return output_.get(); }

  /// Writes down what was printed, at most kMostAtOnce bytes, so that one service cannot keep the
  /// caller from the others.
  void Drain();
  static constexpr std::int64_t kMostAtOnce = 1 << 20;

  /// The last line that is not empty, or its end where it is long; empty when nothing was printed.
  std::string LastLine() const;

 private:
  bool Open();
  void Rotate();
  void KeepFolder();
  void Write(const char* bytes, std::int64_t count);

  std::string path_;
  std::int64_t max_bytes_;
  base::Descriptor input_, output_, file_;
  dev_t device_ = 0;
  ino_t inode_ = 0;
  std::int64_t size_ = 0;       // of the file
  std::int64_t looked_ms_ = 0;  // when the file was last seen in its folder
  bool failing_ = false;
  std::string recent_;  // the end of what was printed
};

/// NAME.1.log of NAME.log.
std::string OlderLog(const std::string& path);

}  // namespace prospect::services
