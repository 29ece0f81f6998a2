#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace prospect::services {

/// What a deployment's services.json says of it.
struct DeploymentFacts {
  std::int64_t deployment = 0;
  std::string bus;
  std::string task;       ///< its name
  std::string task_file;  ///< whole path; empty: an installed one
  std::string weights;
  std::string world;  ///< "simulator", "robot" or "video"
  std::string key;    ///< file; empty: the bus is open
  std::string logs;   ///< folder
  int workers = 0;    ///< as wished for
};

/// Nothing: there is no such file, or not a whole one.
std::optional<DeploymentFacts> ReadFacts(const std::string& services_file);

/// What somebody asks for who wants an episode of a deployment; empty or -1: whatever is up.
struct Wish {
  std::string task;
  std::string weights;
  int workers = -1;
  bool scene = false;  ///< other objects, legs or another tower
};

/// Why a deployment cannot do what is asked for, in one line that names both; empty: it can.
std::string Contradiction(const DeploymentFacts& up, const Wish& wish);

/// A weights file by its whole path; what is no file ("scripted") as it is.
std::string WholePath(const std::string& weights);

/// A service that the supervisor gave up.
struct GivenUp {
  std::string name;
  int status = 0;  ///< its exit status
  std::string last_words;
};

std::vector<GivenUp> ReadGivenUp(const std::string& services_file);

}  // namespace prospect::services
