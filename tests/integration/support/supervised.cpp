#include "tests/integration/support/supervised.h"

#include <algorithm>

namespace prospect::tests {

using nlohmann::json;

Process Supervised::Start(const Options& options, const std::string& log,
                          const std::vector<std::string>& more) {
  std::vector<std::string> arguments{"--bus",     witness.bus.url(),
                                     "--task",    "navigation",
                                     "--weights", options.weights,
                                     "--workers", std::to_string(options.workers),
                                     "--state",   folder,
                                     "--logs",    folder,
                                     "--open"};  // the witness has no key
  if (!options.chaos.empty()) arguments.insert(arguments.end(), {"--chaos", options.chaos});
  arguments.insert(arguments.end(), more.begin(), more.end());
  arguments.insert(arguments.end(), {"--", "--objects", "7"});
  arguments.insert(arguments.end(), options.simulator.begin(), options.simulator.end());
  return Process("prospect-supervisor", arguments, folder + "/" + log + ".log");
}

bool Supervised::AllReady(int workers) {
  return witness.Until(
      [&] {
        return witness.Ready("simulator", 1) && witness.Ready("model", 1) &&
               witness.Ready("worker", workers);
      },
      20000);
}

std::map<std::string, json> Supervised::Services() const {
  std::map<std::string, json> services;
  const json file = json::parse(ReadText(folder + "/services.json"), nullptr, false);
  if (file.is_discarded()) return services;
  for (const json& service : file.at("services")) services[service.at("name")] = service;
  return services;
}

int Supervised::PidOf(const std::string& name) const {
  const auto services = Services();
  return services.contains(name) ? services.at(name).at("pid").get<int>() : -1;
}

std::vector<int> Supervised::Pids() const {
  std::vector<int> pids;
  for (const auto& [name, service] : Services()) pids.push_back(service.at("pid"));
  return pids;
}

bool Supervised::BackWithin(const std::string& name, int old_pid, int milliseconds) {
  return witness.Until(
      [&] {
        const int pid = PidOf(name);
        return pid > 0 && pid != old_pid &&
               std::any_of(witness.health.begin(), witness.health.end(),
                           [pid](const auto& known) { return known.second.pid == pid; });
      },
      milliseconds);
}

}  // namespace prospect::tests
