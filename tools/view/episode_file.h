#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/exit_error.h"

namespace prospect::tools {

// What a result.json says was carried out.
struct CarriedOut {
  std::string task;
  std::string world_version;  // empty in files that do not say it
  std::uint64_t seed = 0;
  int objects = 0;      // navigation: objects on the site
  int plan_length = 0;  // actions in a complete plan
  std::vector<int> actions;
};

struct EpisodeFileError : ExitError {
  explicit EpisodeFileError(const std::string& message) : ExitError(kExitDataFile, message) {}
};

// Throws EpisodeFileError, naming the file, if it cannot be read or is no result of an episode.
CarriedOut ReadEpisodeResult(const std::string& path);

}  // namespace prospect::tools
