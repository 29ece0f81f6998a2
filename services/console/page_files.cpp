#include "services/console/page_files.h"

#include <filesystem>
#include <fstream>
#include <iterator>

#include "base/exit_error.h"

namespace prospect::services::console {
namespace {

namespace fs = std::filesystem;

std::string TextOf(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw ExitError(kExitDataFile, "the console's page is not whole: no " + path.string());
  return {std::istreambuf_iterator<char>(in), {}};
}

const char* TypeOf(const std::string& extension) {
  if (extension == ".html") return "text/html; charset=utf-8";
  if (extension == ".css") return "text/css; charset=utf-8";
  if (extension == ".js") return "text/javascript; charset=utf-8";
  if (extension == ".svg") return "image/svg+xml";
  return nullptr;
}

}  // namespace

PageFiles::PageFiles(const std::string& folder, const std::string& d3) {
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder, none)) {
    const char* type = TypeOf(entry.path().extension().string());
    if (type) files_["/" + entry.path().filename().string()] = {type, TextOf(entry.path())};
  }
  files_["/d3.min.js"] = {TypeOf(".js"), TextOf(d3)};
  files_["/"] = {TypeOf(".html"), TextOf(fs::path(folder) / "index.html")};
}

const PageFiles::File* PageFiles::Find(const std::string& path) const {
  const auto found = files_.find(path);
  return found == files_.end() ? nullptr : &found->second;
}

}  // namespace prospect::services::console
