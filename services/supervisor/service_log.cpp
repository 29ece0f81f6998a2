#include "services/supervisor/service_log.h"

#include <fcntl.h>
#include <spdlog/spdlog.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "base/exit_error.h"
#include "services/common/clock.h"

namespace prospect::services {
namespace {

constexpr std::size_t kRecent = 4096;
constexpr std::int64_t kLookEveryMs = 1000;

}  // namespace

std::string OlderLog(const std::string& path) {
  const std::filesystem::path file(path);
  return (file.parent_path() / file.stem()).string() + ".1" + file.extension().string();
}

ServiceLog::ServiceLog(std::string path, std::int64_t max_bytes)
    : path_(std::move(path)), max_bytes_(max_bytes) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) {
    throw std::runtime_error(std::string("no pipe for a log: ") + std::strerror(errno));
  }
  output_ = base::Descriptor(ends[0]);
  input_ = base::Descriptor(ends[1]);
  fcntl(output_.get(), F_SETFL, O_NONBLOCK);
  std::error_code ignored;
  std::filesystem::remove(path_, ignored);
  std::filesystem::remove(OlderLog(path_), ignored);
  if (Open()) return;
  throw ExitError(kExitDisk, "cannot write " + path_ + " (" + std::strerror(errno) +
                                 "): check the folder and the space left");
}

bool ServiceLog::Open() {
  std::error_code ignored;
  std::filesystem::create_directories(std::filesystem::path(path_).parent_path(), ignored);
  constexpr int kHow = O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC | O_NOFOLLOW;
  file_ = base::Descriptor(open(path_.c_str(), kHow, 0644));
  struct stat found {};
  if (!file_ || fstat(file_.get(), &found) != 0) return false;
  device_ = found.st_dev;
  inode_ = found.st_ino;
  size_ = found.st_size;
  looked_ms_ = SteadyMs();
  return true;
}

void ServiceLog::Rotate() {
  file_.Close();
  if (std::rename(path_.c_str(), OlderLog(path_).c_str()) != 0) std::remove(path_.c_str());
  Open();
}

// Somebody who removes or renames logs of what runs gets new ones.
void ServiceLog::KeepFolder() {
  if (file_ && SteadyMs() - looked_ms_ < kLookEveryMs) return;
  looked_ms_ = SteadyMs();
  struct stat found {};
  const bool there = file_ && stat(path_.c_str(), &found) == 0 && found.st_dev == device_ &&
                     found.st_ino == inode_;
  if (!there) Open();
}

void ServiceLog::Write(const char* bytes, std::int64_t count) {
  KeepFolder();
  if (size_ + count > max_bytes_) Rotate();
  const ssize_t done = file_ ? write(file_.get(), bytes, static_cast<std::size_t>(count)) : -1;
  const bool written = done == count;
  size_ += std::max<ssize_t>(done, 0);
  // Said once: the supervisor's own words go to the same disk.
  if (!written && !failing_) {
    spdlog::error("{} cannot be written ({}); its service goes on", path_, std::strerror(errno));
  }
  failing_ = !written;
}

void ServiceLog::Drain() {
  std::array<char, 65536> chunk;
  for (std::int64_t total = 0; total < kMostAtOnce;) {
    const ssize_t count = read(output_.get(), chunk.data(), chunk.size());
    if (count <= 0) return;
    total += count;
    const auto size = static_cast<std::size_t>(count);
    recent_.append(chunk.data(), size);
    if (recent_.size() > kRecent) recent_.erase(0, recent_.size() - kRecent);
    for (std::int64_t at = 0; at < count; at += max_bytes_) {
      Write(chunk.data() + at, std::min<std::int64_t>(max_bytes_, count - at));
    }
  }
}

std::string ServiceLog::LastLine() const {
  const std::size_t end = recent_.find_last_not_of("\r\n");
  if (end == std::string::npos) return "";
  const std::size_t before = recent_.find_last_of("\r\n", end);
  const std::size_t begin = before == std::string::npos ? 0 : before + 1;
  return recent_.substr(begin, end + 1 - begin);
}

}  // namespace prospect::services
