#include "tests/integration/support/deployment.h"

#include <algorithm>
#include <utility>

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
  const bool others = std::find(more.begin(), more.end(), "--weights") != more.end();
  const std::vector<std::string> usual{"--weights", "scripted:7"};
  return Start("prospect-model-server", others ? std::vector<std::string>() : usual, more);
}

Process& Deployment::Worker(const std::vector<std::string>& more) {
  return Start("prospect-worker", {}, more);
}

Process& Deployment::Executive(const std::vector<std::string>& more, int seed) {
  std::vector<std::string> arguments{"--seed", std::to_string(seed), "--out", folder + "/out"};
  // An option may be given only once, so what a test says takes the place of the usual.
  const std::pair<const char*, const char*> usual[] = {
      {"--objects", "7"}, {"--legs", "3"}, {"--samples", "150"}};
  const auto given = [&more](const char* option) {
    return std::find(more.begin(), more.end(), option) != more.end();
  };
  for (const auto& [option, value] : usual) {
    const bool other_world = given("--tower") && option != std::string("--samples");
    if (!given(option) && !other_world) arguments.insert(arguments.end(), {option, value});
  }
  return Start("prospect-executive", arguments, more);
}

void Deployment::Forget(const Process& process) {
  processes_.remove_if([&](const Process& one) { return &one == &process; });
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
