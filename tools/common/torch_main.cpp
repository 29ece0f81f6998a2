#include "tools/common/torch_main.h"

#include <c10/util/Exception.h>

namespace prospect::tools {

int RunTorchMain(const std::function<int()>& body, const std::string& prefix, ExitCode others) {
  const auto without_stack = [&body] {
    try {
      return body();
    } catch (const c10::Error& error) {
      const std::string text = error.what_without_backtrace();
      throw ExitError(kExitTaskFailure, text.substr(0, text.find('\n')));
    }
  };
  return RunMain(without_stack, prefix, others);
}

}  // namespace prospect::tools
