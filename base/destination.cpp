#include "base/destination.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <memory>

#include "base/disk_error.h"

namespace prospect::base {
namespace {

constexpr int kMostLinks = 40;  // as the kernel's own limit

std::string FolderOf(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  if (slash == std::string::npos) return ".";
  return slash == 0 ? "/" : path.substr(0, slash);
}

std::string RealPath(const std::string& path) {
  const std::unique_ptr<char, decltype(&std::free)> real(::realpath(path.c_str(), nullptr),
                                                         &std::free);
  return real ? real.get() : "";
}

// In a folder that anybody may write to, a link of somebody else's leads where they want us to
// write: as the kernel's fs.protected_symlinks has it, only our own and the folder's owner's count.
void RequireTrusted(const std::string& link, const struct stat& info) {
  struct stat folder {};
  if (::stat(FolderOf(link).c_str(), &folder) != 0) FailToWrite(link, errno);
  const bool anybodys = (folder.st_mode & S_ISVTX) != 0 && (folder.st_mode & S_IWOTH) != 0;
  if (anybodys && info.st_uid != ::geteuid() && info.st_uid != folder.st_uid)
    throw DiskError(link +
                    ": cannot be written (a link of another user in a folder that anybody "
                    "may write to)");
}

// Where a link leads; its text, if it is a relative one, counts from the link's own folder.
std::string TargetOf(const std::string& link) {
  char text[4096];
  const ssize_t length = ::readlink(link.c_str(), text, sizeof text);
  if (length < 0) FailToWrite(link, errno);
  const std::string target(text, static_cast<std::size_t>(length));
  return target.rfind('/', 0) == 0 ? target : FolderOf(link) + "/" + target;
}

// The number of a descriptor of this process that `path` names, or -1. The kernel's links to them
// cannot be followed by their text ("pipe:[4711]"), and opening one anew would begin a file again
// at its first byte.
int OwnDescriptor(const std::string& path) {
  const std::string name = path.substr(path.rfind('/') + 1);
  const bool number =
      !name.empty() && name.size() < 8 && name.find_first_not_of("0123456789") == std::string::npos;
  if (!number) return -1;
  const std::string own = RealPath("/proc/self");
  return !own.empty() && RealPath(FolderOf(path)) == own + "/fd" ? std::stoi(name) : -1;
}

}  // namespace

Destination DestinationOf(const std::string& path) {
  using Kind = Destination::Kind;
  std::string at = path;
  for (int links = 0; links < kMostLinks; ++links) {
    if (const int own = OwnDescriptor(at); own >= 0) return {Kind::kStream, at, own};
    struct stat info {};
    if (::lstat(at.c_str(), &info) != 0) {
      if (errno == ENOENT) return {Kind::kNew, at, -1};
      FailToWrite(path, errno);
    }
    if (S_ISREG(info.st_mode)) return {Kind::kPlain, at, -1};
    if (S_ISDIR(info.st_mode)) FailToWrite(path, EISDIR);
    if (!S_ISLNK(info.st_mode)) return {Kind::kStream, at, -1};
    RequireTrusted(at, info);
    at = TargetOf(at);
  }
  FailToWrite(path, ELOOP);
}

int WriteAll(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

void WriteStream(const Destination& stream, std::string_view bytes) {
  std::fflush(stdout);
  const int file = stream.descriptor >= 0
                       ? ::fcntl(stream.descriptor, F_DUPFD_CLOEXEC, 0)
                       : ::open(stream.path.c_str(), O_WRONLY | O_NOCTTY | O_CLOEXEC);
  if (file < 0) FailToWrite(stream.path, errno);
  const int fault = WriteAll(file, bytes);
  if (::close(file) != 0 && fault == 0) FailToWrite(stream.path, errno);
  if (fault != 0) FailToWrite(stream.path, fault);
}

}  // namespace prospect::base
