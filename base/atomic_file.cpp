#include "base/atomic_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <utility>

#include "base/disk_error.h"
#include "base/lock.h"

namespace prospect::base {
namespace {

namespace fs = std::filesystem;

constexpr int kMostNames = 1000;           // writers of one file at a time
constexpr std::size_t kLongestStem = 200;  // bytes; a name has at most 255

// ".trials.part.h5", ".trials.part1.h5", ...: hidden, so that no pattern takes it for a whole file;
// with the ending, by which libraries choose what they write.
std::string OtherName(const std::string& path, int number) {
  const fs::path file(path);
  const std::string part = number == 0 ? ".part" : ".part" + std::to_string(number);
  const std::string stem = file.stem().string().substr(0, kLongestStem);
  return (file.parent_path() / ("." + stem + part + file.extension().string())).string();
}

// Whether `name` still is the open file, a plain one of our own that nobody else can reach.
bool IsStillOurs(int file, const std::string& name) {
  struct stat held {};
  struct stat named {};
  return ::fstat(file, &held) == 0 && ::lstat(name.c_str(), &named) == 0 &&
         held.st_dev == named.st_dev && held.st_ino == named.st_ino && S_ISREG(held.st_mode) &&
         held.st_uid == ::geteuid() && held.st_nlink == 1;
}

}  // namespace

AtomicFile::AtomicFile(const std::string& path, Rivals rivals)
    : path_(path), to_(DestinationOf(path)) {
  if (to_.kind == Destination::Kind::kPlain && ::access(to_.path.c_str(), W_OK) != 0)
    FailToWrite(path_, errno);  // a rename would not ask
  to_.kind == Destination::Kind::kStream ? OpenElsewhere() : OpenBeside(rivals);
}

AtomicFile::~AtomicFile() {
  if (file_ < 0) return;
  std::remove(temporary_.c_str());
  ::close(file_);
}

// Takes the first name that no living process is writing under. A lock that was got says nothing of
// the name, which its writer may have given away in between: then the same name is tried again.
void AtomicFile::OpenBeside(Rivals rivals) {
  for (int number = 0, tries = 0; number < kMostNames && tries < 2 * kMostNames; ++tries) {
    temporary_ = OtherName(to_.path, number);
    file_ =
        ::open(temporary_.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0666);
    // A name that somebody else has taken, with a folder, a link or a file of theirs, is passed
    // over.
    const int fault = file_ < 0 ? errno : 0;
    struct stat taken {};
    if (fault != 0 && ::lstat(temporary_.c_str(), &taken) != 0) FailToWrite(path_, fault);
    const bool locked = file_ >= 0 && TryLock(file_);
    if (locked && IsStillOurs(file_, temporary_)) {
      if (::ftruncate(file_, 0) != 0) FailToWrite(path_, errno);
      return;
    }
    const bool busy = file_ >= 0 && !locked;
    const std::string words = busy ? InUseWords(path_, file_) : "";
    if (file_ >= 0) ::close(file_);
    file_ = -1;
    if (busy && rivals == Rivals::kRefused) throw InUseError(words);
    struct stat left {};
    if (busy || ::lstat(temporary_.c_str(), &left) == 0) ++number;
  }
  throw DiskError(path_ + ": cannot be written: no name is free for it in its folder");
}

// Libraries cannot write into a pipe as into a file, so that they write somewhere else first.
void AtomicFile::OpenElsewhere() {
  std::error_code error;
  const std::string ending = fs::path(path_).extension().string();
  temporary_ = (fs::temp_directory_path(error) / "prospect-XXXXXX").string() + ending;
  file_ = ::mkostemps(temporary_.data(), static_cast<int>(ending.size()), O_CLOEXEC);
  if (file_ < 0) FailToWrite(temporary_, errno);
}

void AtomicFile::Write(std::string_view bytes) const {
  ::lseek(file_, 0, SEEK_END);
  const int fault = WriteAll(file_, bytes);
  if (fault != 0) FailToWrite(path_, fault);
}

void AtomicFile::Reserve(std::uintmax_t bytes) const {
  const int taken = ::fallocate(file_, FALLOC_FL_KEEP_SIZE, 0, static_cast<off_t>(bytes));
  if (taken == 0 || (errno != ENOSPC && errno != EDQUOT)) return;
  throw DiskError(path_ + ": needs up to " + std::to_string((bytes >> 20) + 1) +
                  " MB, and the disk is full; make room or choose another disk");
}

void AtomicFile::Trim() const {
  struct stat info {};
  if (::fstat(file_, &info) == 0 && ::ftruncate(file_, info.st_size) == 0) return;
  FailToWrite(path_, errno);
}

// Of a file that is replaced; the owner's, too, where that is allowed, as for root.
void AtomicFile::KeepMode() const {
  struct stat before {};
  if (::lstat(to_.path.c_str(), &before) != 0 || !S_ISREG(before.st_mode)) return;
  const bool owner_kept = ::fchown(file_, before.st_uid, before.st_gid) == 0;
  const mode_t kept = owner_kept ? 07777 : 01777;  // set-uid is for the owner it was given by
  if (::fchmod(file_, before.st_mode & kept) != 0) FailToWrite(path_, errno);
}

void AtomicFile::Commit() {
  if (to_.kind == Destination::Kind::kStream) {
    const auto size = fs::file_size(temporary_);
    void* bytes = size == 0 ? nullptr : ::mmap(nullptr, size, PROT_READ, MAP_SHARED, file_, 0);
    if (bytes == MAP_FAILED) FailToWrite(path_, errno);
    WriteStream(to_, {static_cast<const char*>(bytes), size});
    if (bytes != nullptr) ::munmap(bytes, size);
    return;
  }
  KeepMode();
  if (::fsync(file_) != 0) FailToWrite(path_, errno);
  if (::rename(temporary_.c_str(), to_.path.c_str()) != 0) FailToWrite(path_, errno);
  ::close(std::exchange(file_, -1));
}

void WriteFile(const std::string& path, std::string_view bytes) {
  const Destination to = DestinationOf(path);
  if (to.kind == Destination::Kind::kStream) return WriteStream(to, bytes);
  AtomicFile file(path);
  file.Write(bytes);
  file.Commit();
}

}  // namespace prospect::base
