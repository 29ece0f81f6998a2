#include "services/supervisor/facts.h"
#include "cli/installation.h"

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

namespace prospect::services {
namespace {

using nlohmann::json;

json Read(const std::string& path) {
  std::ifstream in(path);
  return in ? json::parse(in, nullptr, false) : json(json::value_t::discarded);
}

// As a file of JSON gives it back: names in an old encoding lose their strange bytes there.
std::string AsWritten(const std::string& text) {
  return json::parse(json(text).dump(-1, ' ', false, json::error_handler_t::replace));
}

// Of a folder, the task's own file in it.
std::string FileOf(const std::string& weights, const std::string& task) {
  return std::filesystem::is_directory(weights) ? weights + "/" + task + ".safetensors" : weights;
}

}  // namespace

std::optional<DeploymentFacts> ReadFacts(const std::string& services_file) try {
  const json file = Read(services_file);
  if (file.is_discarded()) return std::nullopt;
  DeploymentFacts facts;
  facts.deployment = file.at("deployment");
  facts.bus = file.at("bus");
  facts.task = file.at("task");
  facts.task_file = file.at("task_file");
  facts.weights = file.at("weights");
  facts.world = file.at("world");
  facts.key = file.at("key");
  facts.logs = file.at("logs");
  facts.workers = file.at("workers");
  return facts;
} catch (const json::exception&) {
  return std::nullopt;
}

std::string Contradiction(const DeploymentFacts& up, const Wish& wish) {
  const std::string here = " on " + up.bus;
  const std::string anew = ": leave the option out, or " + cli::Typed("down") + " and up with it";
  if (!wish.task.empty() && wish.task != up.task) {
    return "--task " + wish.task + ", but " + up.task + " is up" + here + anew;
  }
  if (!wish.weights.empty() && AsWritten(WholePath(FileOf(wish.weights, up.task))) != up.weights) {
    return "--weights " + wish.weights + ", but the model server that is up" + here + " has " +
           up.weights + anew;
  }
  if (wish.scene && up.world != "simulator") {
    return "--objects, --legs and --tower are for the simulator, but a " + up.world + " is up" +
           here + ": leave them out";
  }
  if (wish.workers > up.workers) {
    return "--workers " + std::to_string(wish.workers) + ", but " + std::to_string(up.workers) +
           " are up" + here + ": " + cli::Typed("scale workers=") + std::to_string(wish.workers);
  }
  return "";
}

std::string WholePath(const std::string& weights) {
  std::error_code error;
  const std::filesystem::path whole = std::filesystem::canonical(weights, error);
  return error ? weights : whole.string();
}

std::vector<GivenUp> ReadGivenUp(const std::string& services_file) try {
  std::vector<GivenUp> given_up;
  const json file = Read(services_file);
  if (file.is_discarded()) return {};
  for (const json& service : file.at("services")) {
    if (service.at("state") != "given_up") continue;
    given_up.push_back({service.at("name"), service.at("last_exit"), service.at("last_words")});
  }
  return given_up;
} catch (const json::exception&) {
  return {};
}

}  // namespace prospect::services
