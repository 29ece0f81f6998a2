#include "model/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <utility>

#include "model/dataset.h"

namespace prospect::model {

std::string TemporaryName(const std::string& path, int pid) {
  return path + ".tmp" + std::to_string(pid);
}

AtomicFile::AtomicFile(std::string path)
    : path_(std::move(path)), temporary_(TemporaryName(path_, ::getpid())) {}

AtomicFile::~AtomicFile() { std::remove(temporary_.c_str()); }

void AtomicFile::Commit() const {
  if (std::rename(temporary_.c_str(), path_.c_str()) == 0) return;
  throw DiskError(path_ + ": cannot be written (rename failed); check the folder's permissions");
}

void AtomicFile::Write(const std::vector<std::uint8_t>& bytes) const {
  std::ofstream file(temporary_, std::ios::binary | std::ios::trunc);
  file.write(reinterpret_cast<const char*>(bytes.data()),
             static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file)
    throw DiskError(path_ + ": cannot be written; check the folder and the space on the disk");
}

void AtomicFile::Reserve(std::uintmax_t bytes) const {
  const int file = ::open(temporary_.c_str(), O_WRONLY | O_CLOEXEC);
  const int taken =
      file < 0 ? -1 : ::fallocate(file, FALLOC_FL_KEEP_SIZE, 0, static_cast<off_t>(bytes));
  const bool full = file < 0 || (taken != 0 && (errno == ENOSPC || errno == EDQUOT));
  if (file >= 0) ::close(file);
  if (!full) return;  // or a file system that cannot reserve
  throw DiskError(path_ + ": needs up to " + std::to_string((bytes >> 20) + 1) +
                  " MB, and the disk is full; make room or choose another disk");
}

void AtomicFile::Trim() const {
  [[maybe_unused]] const int cut =
      ::truncate(temporary_.c_str(), static_cast<off_t>(std::filesystem::file_size(temporary_)));
}

}  // namespace prospect::model
