#include "tests/integration/support/deployment.h"

namespace prospect::tests {

Process& Deployment::Start(const std::string& program, std::vector<std::string> arguments,
                           const std::vector<std::string>& more) {
  arguments.insert(arguments.end(), more.begin(), more.end());
  const std::string log = folder + "/" + std::to_string(++started_) + "-" + program + ".log";
  return processes_.emplace_back(program, arguments, log);
}

Process& Deployment::Simulator(const std::vector<std::string>& more) {
  return Start("prospect-simulator", {"--objects", "7"}, more);
}

Process& Deployment::ModelServer(const std::vector<std::string>& more) {
  return Start("prospect-model-server", {"--weights", "scripted:7"}, more);
}

Process& Deployment::Worker() { return Start("prospect-worker", {}, {}); }

Process& Deployment::Executive(const std::vector<std::string>& more, int seed) {
  return Start("prospect-executive",
               {"--seed", std::to_string(seed), "--objects", "7", "--legs", "3", "--samples", "150",
                "--out", folder + "/out"},
               more);
}

bool Deployment::Up(Witness& witness, int workers, const std::vector<std::string>& simulator) {
  Simulator(simulator);
  ModelServer();
  for (int i = 0; i < workers; ++i) Worker();
  return witness.Until(
      [&] {
        return witness.Ready("simulator", 1) && witness.Ready("model", 1) &&
               witness.Ready("worker", workers);
      },
      20000);
}

}  // namespace prospect::tests
