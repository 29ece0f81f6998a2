#include "services/common/run_main.h"

#include <cstdio>
#include <exception>

#include "base/disk_error.h"

namespace prospect::services {

int RunMain(const std::function<int()>& body) {
  try {
    return body();
  } catch (const ExitError& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return error.code();
  } catch (const base::DiskError& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return kExitDisk;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 1;
  }
}

}  // namespace prospect::services
