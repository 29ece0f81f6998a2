#include "model/training/mapped_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace prospect::model {
namespace {

[[noreturn]] void Fail(const std::string& path, const std::string& what) {
  throw std::runtime_error(path + ": " + what + " (" + std::strerror(errno) + ")");
}

/// An open file that closes itself.
struct Descriptor {
  explicit Descriptor(int number) : fd(number) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (fd >= 0) ::close(fd);
  }
  int fd;
};

bool HasSize(const std::string& path, std::size_t bytes) {
  struct stat info {};
  return ::stat(path.c_str(), &info) == 0 && static_cast<std::size_t>(info.st_size) == bytes;
}

void* Map(const Descriptor& file, const std::string& path, std::size_t bytes, int protection) {
  void* data = ::mmap(nullptr, bytes, protection, MAP_SHARED, file.fd, 0);
  if (data == MAP_FAILED) Fail(path, "cannot be mapped into memory");
  return data;
}

void Create(const std::string& path, std::size_t bytes, const std::function<void(void*)>& fill) {
  const std::string temporary = path + ".tmp";
  const Descriptor file(::open(temporary.c_str(), O_RDWR | O_CREAT | O_TRUNC, 0644));
  if (file.fd < 0) Fail(temporary, "cannot be created");
  // Taking the space now turns a full disk into this error and not into a signal later.
  errno = ::posix_fallocate(file.fd, 0, static_cast<off_t>(bytes));
  if (errno != 0) {
    const int reason = errno;
    std::remove(temporary.c_str());
    errno = reason;
    Fail(path, "needs " + std::to_string((bytes >> 20) + 1) + " MB on this disk");
  }
  void* data = Map(file, temporary, bytes, PROT_READ | PROT_WRITE);
  try {
    fill(data);
  } catch (...) {
    ::munmap(data, bytes);
    std::remove(temporary.c_str());
    throw;
  }
  ::munmap(data, bytes);
  if (::fsync(file.fd) != 0 || std::rename(temporary.c_str(), path.c_str()) != 0) {
    Fail(path, "cannot be written");
  }
}

}  // namespace

MappedFile::MappedFile(const std::string& path, std::size_t bytes,
                       const std::function<void(void*)>& fill)
    : bytes_(bytes) {
  if (bytes == 0) throw std::runtime_error(path + ": nothing to cache; is the data set empty?");
  if (!HasSize(path, bytes)) Create(path, bytes, fill);
  const Descriptor file(::open(path.c_str(), O_RDONLY));
  if (file.fd < 0) Fail(path, "cannot be opened");
  data_ = Map(file, path, bytes, PROT_READ);
}

MappedFile::MappedFile(MappedFile&& other) noexcept
    : data_(std::exchange(other.data_, nullptr)), bytes_(other.bytes_) {}

MappedFile& MappedFile::operator=(MappedFile&& other) noexcept {
  std::swap(data_, other.data_);
  std::swap(bytes_, other.bytes_);
  return *this;
}

MappedFile::~MappedFile() {
  if (data_ != nullptr) ::munmap(const_cast<void*>(data_), bytes_);
}

}  // namespace prospect::model
