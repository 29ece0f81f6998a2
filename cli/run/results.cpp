#include "cli/run/results.h"

#include <fcntl.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>

#include "base/exit_error.h"
#include "base/lock.h"

namespace prospect::cli {

ResultsFolder::ResultsFolder(const std::string& path) : path_(path) {
  std::error_code error;
  std::filesystem::create_directories(logs(), error);
  if (error) base::FailToWrite(path, error.value());
  lock_ = base::Descriptor(open(logs().c_str(), O_RDONLY));
  if (!lock_) base::FailToWrite(path, errno);
  if (base::TryLock(lock_.get())) return;
  throw ExitError(kExitDisk, path + " is in use by " + base::HolderOf(lock_.get()) +
                                 ": wait until it has ended, or give another --out");
}

bool IsNew(const std::string& file, std::time_t start) {
  struct stat info {};
  return stat(file.c_str(), &info) == 0 && info.st_mtime >= start;
}

void TellFiles(const std::string& folder, const Words& names, std::time_t start) {
  std::string written;
  for (const std::string& name : names)
    if (IsNew(folder + "/" + name, start)) written += " " + name;
  if (!written.empty()) std::fprintf(stderr, "Files in %s:%s\n", folder.c_str(), written.c_str());
}

}  // namespace prospect::cli
