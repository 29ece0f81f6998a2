#pragma once

#include <string>
#include <vector>

namespace prospect::services {

/// One service of a deployment and how it is started.
struct ServiceSpec {
  std::string name;  ///< "model", "simulator", "worker-1": also its log's name
  std::vector<std::string> command;
};

/// What a deployment consists of.
struct DeploymentSpec {
  std::string programs;  ///< folder of the programs
  std::string bus;
  std::string task;       ///< its name
  std::string task_file;  ///< whole path; empty: an installed one
  std::string weights;
  std::string key;    ///< file, by which PROSPECT_KEY_FILE is set; empty: an open bus
  std::string chaos;  ///< faults for every process, its seed moved on from one to the next
  std::vector<std::string> scene;  ///< further arguments of the simulator
  bool simulator = true;           ///< false: a robot is in its place
  bool player = false;             ///< a video is in its place; `scene` is the player's
  bool console = false;            ///< with a page in the browser
  bool control = false;            ///< whose buttons may be pressed
};

ServiceSpec ModelSpec(const DeploymentSpec& deployment);
ServiceSpec SimulatorSpec(const DeploymentSpec& deployment);
/// @param state folder, where its address will lie, in console.url
ServiceSpec ConsoleSpec(const DeploymentSpec& deployment, const std::string& state);
ServiceSpec WorkerSpec(const DeploymentSpec& deployment, int number);

/// `chaos` with every "seed=N" moved on by `steps`, so that processes do not all miss the same
/// messages.
std::string MoveSeeds(const std::string& chaos, int steps);

}  // namespace prospect::services
