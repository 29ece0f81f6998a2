#include "base/line_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

#include "base/destination.h"
#include "base/disk_error.h"

namespace prospect::base {

void AppendLine(const std::string& path, const std::string& line) {
  const int file = ::open(path.c_str(), O_RDWR | O_APPEND | O_CREAT | O_CLOEXEC, 0666);
  if (file < 0) FailToWrite(path, errno);
  while (::flock(file, LOCK_EX) != 0 && errno == EINTR) {
  }
  struct stat before {};
  ::fstat(file, &before);
  char last = '\n';
  const bool cut =
      before.st_size > 0 && ::pread(file, &last, 1, before.st_size - 1) == 1 && last != '\n';
  const int fault = WriteAll(file, (cut ? "\n" : "") + line + "\n");
  const bool taken_back = fault == 0 || ::ftruncate(file, before.st_size) == 0;
  ::close(file);
  if (fault != 0 || !taken_back) FailToWrite(path, fault);
}

}  // namespace prospect::base
