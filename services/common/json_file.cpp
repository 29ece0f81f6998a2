#include "services/common/json_file.h"

#include <unistd.h>

#include <cstdio>
#include <fstream>

#include "services/common/run_main.h"

namespace prospect::services {

void WriteJsonFile(const std::string& path, const nlohmann::json& value) {
  const std::string part = path + ".part" + std::to_string(getpid());
  std::ofstream file(part);
  // Names of files and what others say are in whatever encoding they are.
  file << value.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << "\n";
  file.close();
  if (!file || std::rename(part.c_str(), path.c_str()) != 0) {
    std::remove(part.c_str());
    throw ExitError(kExitDisk, path + " cannot be written: check the folder and the space left");
  }
}

}  // namespace prospect::services
