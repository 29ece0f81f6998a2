#include "services/common/run_main.h"

#include <cstdio>
#include <exception>

namespace prospect::services {

int RunMain(const std::function<int()>& body) {
  try {
    return body();
  } catch (const ExitError& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return error.code();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 1;
  }
}

}  // namespace prospect::services
