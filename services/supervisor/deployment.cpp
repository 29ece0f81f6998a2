#include "services/supervisor/deployment.h"

#include <regex>

namespace prospect::services {
namespace {

// The executive has the seeds as they are.
constexpr int kModelSeed = 1, kSimulatorSeed = 2, kWorkerSeed = 2, kConsoleSeed = 1000;

// `program`: its name, and what comes first of its arguments.
std::vector<std::string> Command(const DeploymentSpec& deployment,
                                 const std::vector<std::string>& program, int seed_steps) {
  std::vector<std::string> command = program;
  command[0].insert(0, deployment.programs + "/");
  command.insert(command.end(), {"--bus", deployment.bus});
  if (!deployment.chaos.empty()) {
    command.insert(command.end(), {"--chaos", MoveSeeds(deployment.chaos, seed_steps)});
  }
  return command;
}

}  // namespace

std::string MoveSeeds(const std::string& chaos, int steps) {
  static const std::regex seed("seed=([0-9]{1,9})");
  std::string moved;
  auto at = chaos.begin();
  for (std::sregex_iterator it(chaos.begin(), chaos.end(), seed), end; it != end; ++it) {
    moved.append(at, chaos.begin() + it->position());
    moved += "seed=" + std::to_string(std::stol((*it)[1]) + steps);
    at = chaos.begin() + it->position() + it->length();
  }
  return moved.append(at, chaos.end());
}

ServiceSpec ModelSpec(const DeploymentSpec& deployment) {
  ServiceSpec spec{"model", Command(deployment, {"prospect-model-server"}, kModelSeed)};
  spec.command.insert(spec.command.end(), {"--weights", deployment.weights});
  const std::string& task = deployment.task_file.empty() ? deployment.task : deployment.task_file;
  if (deployment.weights == "scripted") spec.command.insert(spec.command.end(), {"--task", task});
  return spec;
}

ServiceSpec SimulatorSpec(const DeploymentSpec& deployment) {
  using Words = std::vector<std::string>;
  const Words program =
      deployment.player ? Words{"prospect-video", "play"} : Words{"prospect-simulator"};
  ServiceSpec spec{"simulator", Command(deployment, program, kSimulatorSeed)};
  spec.command.insert(spec.command.end(), {"--task", deployment.task});
  spec.command.insert(spec.command.end(), deployment.scene.begin(), deployment.scene.end());
  return spec;
}

ServiceSpec ConsoleSpec(const DeploymentSpec& deployment, const std::string& state) {
  ServiceSpec spec{"console", Command(deployment, {"prospect-console"}, kConsoleSeed)};
  spec.command.insert(spec.command.end(),
                      {"--no-browser", "--services-file", state + "/services.json", "--url-file",
                       state + "/console.url"});
  if (deployment.control) spec.command.push_back("--control");
  return spec;
}

ServiceSpec WorkerSpec(const DeploymentSpec& deployment, int number) {
  return {"worker-" + std::to_string(number),
          Command(deployment, {"prospect-worker"}, kWorkerSeed + number)};
}

}  // namespace prospect::services
