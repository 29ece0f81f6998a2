#pragma once

#include <ctime>
#include <string>

#include "base/descriptor.h"
#include "cli/run/invocation.h"

namespace prospect::cli {

/// The folder of a command's results, which is its own until it and all that it started have ended.
/// Its folder of logs stands for it, since the executive locks the folder itself.
class ResultsFolder {
 public:
  /// Makes it. @throws DiskError when it cannot be written to, or ExitError (kExitDisk) with who is
  /// using it
  explicit ResultsFolder(const std::string& path);

  std::string logs() const { return path_ + "/logs"; }

 private:
  std::string path_;
  base::Descriptor lock_;  // children have it, too
};

/// Tells on standard error which of these files in `folder` were written since `start`.
void TellFiles(const std::string& folder, const Words& names, std::time_t start);

/// Whether a file was written since then.
bool IsNew(const std::string& file, std::time_t start);

}  // namespace prospect::cli
