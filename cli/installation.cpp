#include "cli/installation.h"

#include <filesystem>
#include <fstream>

namespace prospect::cli {
namespace {

namespace fs = std::filesystem;

fs::path HereFolder() { return fs::read_symlink("/proc/self/exe").parent_path(); }

// The sources that a build folder was configured for; empty: it is no build folder.
fs::path SourcesOf(const fs::path& build) {
  const std::string key = "CMAKE_HOME_DIRECTORY:INTERNAL=";
  std::ifstream cache(build / "CMakeCache.txt");
  for (std::string line; std::getline(cache, line);)
    if (line.starts_with(key)) return line.substr(key.size());
  return {};
}

fs::path DataRoot() {
  const fs::path here = HereFolder();
  for (const char* installed : {"../share/prospect", "../../share/prospect"}) {
    std::error_code none;
    if (fs::is_directory(here / installed, none)) return (here / installed).lexically_normal();
  }
  const fs::path sources = SourcesOf(here.parent_path());
  return sources.empty() ? here.parent_path() : sources;
}

}  // namespace

std::string ProgramsFolder() {
  const fs::path here = HereFolder();
  const fs::path installed = (here / "../lib/prospect").lexically_normal();
  std::error_code none;
  return (fs::is_directory(installed, none) ? installed : here).string();
}

std::string DataFolder(const std::string& name) { return (DataRoot() / name).string(); }

}  // namespace prospect::cli
