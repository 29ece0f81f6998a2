#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace prospect::model {

/// A file that is written under a temporary name and takes its real one in Commit(); without that,
/// nothing of it remains. For the writers of this room; one thread.
class AtomicFile {
 public:
  explicit AtomicFile(std::string path);
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  ~AtomicFile();

  const std::string& temporary() const { return temporary_; }

  /// Gives the file its name. Throws DiskError.
  void Commit() const;
  /// All of the file at once. Throws DiskError.
  void Write(const std::vector<std::uint8_t>& bytes) const;
  /// Takes the disk space of the first `bytes` of a file that libhdf5 has created there, because
  /// libhdf5 crashes when it gives out under its hands. Throws DiskError where there is no room.
  void Reserve(std::uintmax_t bytes) const;
  /// Gives back what Reserve() took too much.
  void Trim() const;

 private:
  std::string path_;
  std::string temporary_;
};

}  // namespace prospect::model
