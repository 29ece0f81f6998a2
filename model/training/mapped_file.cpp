#include "model/training/mapped_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <utility>

#include "base/atomic_file.h"
#include "base/disk_error.h"

namespace prospect::model {
namespace {

[[noreturn]] void Fail(const std::string& path, const std::string& what) {
  throw base::DiskError(path + ": " + what + " (" + std::strerror(errno) + ")");
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

void* Map(int file, const std::string& path, std::size_t bytes, int protection) {
  void* data = ::mmap(nullptr, bytes, protection, MAP_SHARED, file, 0);
  if (data == MAP_FAILED) Fail(path, "cannot be mapped into memory");
  return data;
}

// What stands behind the cache's bytes.
struct Seal {
  char magic[8] = {'p', 'r', 'o', 's', 'p', 'e', 'c', 't'};
  std::uint64_t checksum = 0;  // CRC-32 of the bytes
};

std::uint64_t ChecksumOf(const void* data, std::size_t bytes) {
  return ::crc32_z(::crc32_z(0, nullptr, 0), static_cast<const Bytef*>(data), bytes);
}

// Whether what is mapped, `bytes` of cache and a seal, is as it was when it was made.
bool IsWhole(const void* data, std::size_t bytes) {
  Seal seal;
  const Seal fresh;
  std::memcpy(&seal, static_cast<const char*>(data) + bytes, sizeof seal);
  return std::memcmp(seal.magic, fresh.magic, sizeof seal.magic) == 0 &&
         seal.checksum == ChecksumOf(data, bytes);
}

void Create(const std::string& path, std::size_t bytes, const std::function<void(void*)>& fill) {
  base::AtomicFile target(path);
  const std::size_t size = bytes + sizeof(Seal);
  // Taking the space now turns a full disk into this error and not into a signal later.
  errno = ::posix_fallocate(target.descriptor(), 0, static_cast<off_t>(size));
  if (errno != 0) Fail(path, "needs " + std::to_string((size >> 20) + 1) + " MB on this disk");
  void* data = Map(target.descriptor(), path, size, PROT_READ | PROT_WRITE);
  const auto unmap = [size](void* mapped) { ::munmap(mapped, size); };
  const std::unique_ptr<void, decltype(unmap)> mapping(data, unmap);
  fill(data);
  Seal seal;
  seal.checksum = ChecksumOf(data, bytes);
  std::memcpy(static_cast<char*>(data) + bytes, &seal, sizeof seal);
  target.Commit();
}

}  // namespace

MappedFile::MappedFile(const std::string& path, std::size_t bytes,
                       const std::function<void(void*)>& fill)
    : bytes_(bytes) {
  if (bytes == 0) throw std::runtime_error(path + ": nothing to cache; is the data set empty?");
  if (Open(path)) return;
  Create(path, bytes, fill);
  if (!Open(path)) throw base::DiskError(path + ": is damaged as soon as it is written");
}

// A cache that is there and is not whole is said, because making it anew takes long.
bool MappedFile::Open(const std::string& path) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.fd < 0 && errno == ENOENT) return false;
  if (file.fd < 0) Fail(path, "cannot be opened");
  struct stat info {};
  const std::size_t size = bytes_ + sizeof(Seal);
  if (::fstat(file.fd, &info) == 0 && static_cast<std::size_t>(info.st_size) == size) {
    data_ = Map(file.fd, path, size, PROT_READ);
    if (IsWhole(data_, bytes_)) return true;
    ::munmap(const_cast<void*>(std::exchange(data_, nullptr)), size);
  }
  std::fprintf(stderr, "%s: is damaged (its checksum does not fit); it is made anew\n",
               path.c_str());
  return false;
}

MappedFile::MappedFile(MappedFile&& other) noexcept
    : data_(std::exchange(other.data_, nullptr)), bytes_(other.bytes_) {}

MappedFile& MappedFile::operator=(MappedFile&& other) noexcept {
  std::swap(data_, other.data_);
  std::swap(bytes_, other.bytes_);
  return *this;
}

MappedFile::~MappedFile() {
  if (data_ != nullptr) ::munmap(const_cast<void*>(data_), bytes_ + sizeof(Seal));
}

}  // namespace prospect::model
