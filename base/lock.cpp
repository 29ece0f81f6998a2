#include "base/lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <utility>

namespace prospect::base {
namespace {

constexpr std::size_t kMostWords = 120;  // of a command line, in bytes

std::string CommandOf(const std::string& pid) {
  std::ifstream file("/proc/" + pid + "/cmdline");
  std::string words((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  while (!words.empty() && words.back() == '\0') words.pop_back();
  std::replace(words.begin(), words.end(), '\0', ' ');
  const std::size_t end = std::min(words.find(' '), words.size());
  const std::size_t slash = words.rfind('/', end);  // the program's folder says nothing
  if (slash != std::string::npos) words.erase(0, slash + 1);
  if (words.size() > kMostWords) words = words.substr(0, kMostWords) + "...";
  return words;
}

// "MAJOR:MINOR:INODE" as /proc/locks writes it.
std::string PlaceOf(const struct stat& info) {
  char text[64];
  std::snprintf(text, sizeof text, "%02x:%02x:%llu", major(info.st_dev), minor(info.st_dev),
                static_cast<unsigned long long>(info.st_ino));
  return text;
}

}  // namespace

bool TryLock(int file) {
  while (::flock(file, LOCK_EX | LOCK_NB) != 0) {
    if (errno != EINTR) return errno != EWOULDBLOCK;
  }
  return true;
}

std::string HolderOf(int file) {
  struct stat info {};
  if (::fstat(file, &info) != 0) return "another process";
  const std::string place = PlaceOf(info);
  std::ifstream locks("/proc/locks");
  for (std::string line; std::getline(locks, line);) {
    std::istringstream words(line);
    std::string number, kind, advisory, mode, pid, where;
    words >> number >> kind >> advisory >> mode >> pid >> where;
    if (kind != "FLOCK" || where != place) continue;
    const std::string command = CommandOf(pid);
    if (!command.empty()) return command + " (pid " + pid + ")";
  }
  return "another process";
}

std::string InUseWords(const std::string& path, int file) {
  return path + ": is in use by " + HolderOf(file) +
         "; wait until it has ended, or name another place";
}

Lock::Lock(const std::string& path) : file_(::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
  if (file_ < 0) FailToWrite(path, errno);
  if (TryLock(file_)) return;
  const std::string words = InUseWords(path, file_);
  ::close(file_);
  throw InUseError(words);
}

Lock::Lock(Lock&& other) noexcept : file_(std::exchange(other.file_, -1)) {}

Lock& Lock::operator=(Lock&& other) noexcept {
  std::swap(file_, other.file_);
  return *this;
}

Lock::~Lock() {
  if (file_ >= 0) ::close(file_);
}

Lock LockFolder(const std::string& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error) FailToWrite(path, error.value());
  return Lock(path);
}

}  // namespace prospect::base
