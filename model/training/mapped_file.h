#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace prospect::model {

/// A cache file mapped into memory read-only, so that caches larger than memory work and several
/// processes share one copy. Movable, not copyable. Reading is thread-safe.
class MappedFile {
 public:
  /// Maps `path` if it holds `bytes` bytes and the checksum behind them fits (all of them are read
  /// for that). Else calls `fill` on a writable mapping of that size under another name, seals it
  /// with its checksum and gives it its name (base/atomic_file.h); a damaged file is said on
  /// stderr. Throws base::DiskError naming the file (disk full, no permission); what `fill` throws
  /// passes through.
  MappedFile(const std::string& path, std::size_t bytes, const std::function<void(void*)>& fill);
  MappedFile(MappedFile&& other) noexcept;
  MappedFile& operator=(MappedFile&& other) noexcept;
  ~MappedFile();

  const void* data() const { return data_; }
  std::size_t bytes() const { return bytes_; }

 private:
  /// Maps the file; false: there is none, or it is damaged.
  bool Open(const std::string& path);

  const void* data_ = nullptr;
  std::size_t bytes_ = 0;
};

}  // namespace prospect::model
