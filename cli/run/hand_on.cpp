#include "cli/run/invocation.h"

namespace prospect::cli {

Words HandedOn(const CLI::App& app, const CLI::App& other) {
  return Given(app, [&other](const std::string& name) {
    return name != "--help" && other.get_option_no_throw(name) != nullptr;
  });
}

}  // namespace prospect::cli
