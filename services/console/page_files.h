#pragma once

#include <map>
#include <string>

namespace prospect::services::console {

/// The page, read whole at the start: what is not in this table is not served, so no path of a
/// request ever meets the disk. Constant afterwards; safe from any thread.
class PageFiles {
 public:
  struct File {
    std::string type, text;
  };

  /// @param folder of the page @param d3 its d3.min.js
  /// @throws ExitError (kExitDataFile) when one of them is missing
  PageFiles(const std::string& folder, const std::string& d3);

  /// @param path such as "/tree.js"; "/" is the page @return null: there is none
  const File* Find(const std::string& path) const;

 private:
  std::map<std::string, File> files_;
};

}  // namespace prospect::services::console
