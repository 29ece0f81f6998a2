#include "base/run_main.h"

#include <cstdio>
#include <exception>
#include <filesystem>
#include <stdexcept>

namespace prospect {
namespace {

ExitCode Tell(const std::string& prefix, const std::exception& error, ExitCode code) {
  std::fprintf(stderr, "%s: %s\n", prefix.c_str(), error.what());
  return code;
}

}  // namespace

int RunMain(const std::function<int()>& body, const std::string& prefix, ExitCode others) {
  try {
    return body();
  } catch (const ExitError& error) {
    return Tell(prefix, error, error.code());
  } catch (const std::invalid_argument& error) {
    return Tell(prefix, error, kExitUsage);
  } catch (const std::filesystem::filesystem_error& error) {
    return Tell(prefix, error, kExitDisk);
  } catch (const std::exception& error) {
    return Tell(prefix, error, others);
  }
}

}  // namespace prospect
