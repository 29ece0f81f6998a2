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

// Empty: it is not installed.
fs::path InstalledData() {
  for (const char* data : {"../share/prospect", "../../share/prospect"}) {
    const fs::path folder = HereFolder() / data;
    std::error_code none;
    if (fs::is_directory(folder, none)) return folder.lexically_normal();
  }
  return {};
}

fs::path DataRoot() {
  if (IsInstalled()) return InstalledData();
  const fs::path build = HereFolder().parent_path(), sources = SourcesOf(build);
  return sources.empty() ? build : sources;
}

}  // namespace

bool IsInstalled() { return !InstalledData().empty(); }

std::string TypedName() { return IsInstalled() ? "prospect" : "./prospect"; }

std::string Typed(std::string_view command) { return TypedName() + " " + std::string(command); }

std::string ProgramsFolder() {
  const fs::path here = HereFolder();
  const fs::path installed = (here / "../lib/prospect").lexically_normal();
  std::error_code none;
  return (fs::is_directory(installed, none) ? installed : here).string();
}

std::string DataFolder(const std::string& name) { return (DataRoot() / name).string(); }

}  // namespace prospect::cli
