#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace prospect::model {

/// A cache file mapped into memory read-only, so that caches larger than memory work and several
/// processes share one copy. Movable, not copyable. Reading is thread-safe.
class MappedFile {
 public:
  /// Maps `path` if it has exactly `bytes` bytes. Else calls `fill` on a writable mapping of that
  /// size under another name, flushes it and renames it into place: a killed run leaves no half
  /// cache. Throws std::runtime_error naming the file (disk full, no permission); what `fill`
  /// throws passes through.
  MappedFile(const std::string& path, std::size_t bytes, const std::function<void(void*)>& fill);
  MappedFile(MappedFile&& other) noexcept;
  MappedFile& operator=(MappedFile&& other) noexcept;
  ~MappedFile();

  const void* data() const { return data_; }
  std::size_t bytes() const { return bytes_; }

 private:
  const void* data_ = nullptr;
  std::size_t bytes_ = 0;
};

}  // namespace prospect::model
