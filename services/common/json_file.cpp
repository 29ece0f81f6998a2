#include "services/common/json_file.h"

#include <unistd.h>

#include <cstdio>
#include <fstream>

#include "services/common/run_main.h"

namespace prospect::services {

void WriteJsonFile(const std::string& path, const nlohmann::json& value) {
  const std::string part = path + ".part" + std::to_string(getpid());
  std::ofstream file(part);
  file << value.dump(2) << "\n";
  file.close();
  if (!file || std::rename(part.c_str(), path.c_str()) != 0) {
    std::remove(part.c_str());
    throw ExitError(kExitDisk, path + " cannot be written: check the folder and the space left");
  }
}

}  // namespace prospect::services
