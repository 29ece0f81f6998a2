#include "cli/table.h"

#include "cli/commands/oracle.h"

namespace prospect::cli {
namespace {

std::vector<Command> Table() {
  return {
      {"demo", Group::kTry, "one episode with everything started for it; shows the plan"},
      {"explain", Group::kTry,
       "look at the scene, search once and tell why; nothing is carried out"},
      {"setup", Group::kTry, "install and build everything; else a program is built when needed"},
      {"test", Group::kTry, "install, build, run the tests"},

      {"up", Group::kRun, "start simulator, model server and planner workers"},
      {"run", Group::kRun, "one episode against the services that are up"},
      {"scale", Group::kRun, "more or fewer planner workers while they run"},
      {"down", Group::kRun, "stop what is up"},
      {"key", Group::kRun, "the file of the deployment's key, which a robot needs"},
      {"check-robot", Group::kRun, "try a robot in the simulator's place: it moves"},
      {"doctor", Group::kRun, "what this machine lacks for a deployment, and how it is mended"},

      {"status", Group::kLook,
       "each process: state, age of its last sign of life, queue, restarts"},
      {"spy", Group::kLook, "look at the bus with lcm-spy, or count what is said on it"},
      {"record", Group::kLook, "write the bus to a file"},
      {"replay",
       Group::kLook,
       "play a recording onto a bus of its own, without commands",
       "prospect-replay",
       {"play"}},
      {"rebuild", Group::kLook, "search again: from a recording, or from a worker's journal",
       "prospect-replay"},
      {"predict", Group::kLook, "pictures of what comes next in the scene that is up"},
      {"view", Group::kLook, "a picture of a scene, at any size and from any camera",
       "prospect-view"},
      {"messages", Group::kLook, "the message reference, from lcmtypes/"},
      {"version", Group::kLook, "the version"},
      {"completion", Group::kLook, "completions for a shell"},

      {"collect", Group::kTrain, "make training trials", "prospect-collect"},
      {"dataset", Group::kTrain, "look at data sets, pack them, make them of recordings or videos",
       "prospect-dataset"},
      {"train", Group::kTrain, "train the networks", "prospect-train"},

      {"verify", Group::kMeasure, "measure the figures of docs/results.md again",
       "prospect-verify"},
      {"evaluate", Group::kMeasure, "closed loop on scenes that were never trained on",
       "prospect-evaluate"},
      {"tables", Group::kMeasure, "pictures and labels after one and two actions, of variants",
       "prospect-tables"},
      {"figures", Group::kMeasure, "pictures of what the networks keep, imagine and judge",
       "prospect-figures"},
      {"oracle",
       Group::kMeasure,
       "what a world's scenes allow, by trying every plan",
       "prospect-oracle",
       {},
       {},
       Defined<OracleOptions>()},
      {"ceiling", Group::kMeasure, "how well what V, f and T are asked can be known at all",
       "prospect-ceiling"},
      {"takes", Group::kMeasure, "how far two takes of one action differ", "prospect-takes"},
      {"bench", Group::kMeasure, "speed of the search", "prospect-bench"},
      {"bench sim", Group::kMeasure, "speed of the worlds on one core", "prospect-sim-bench"},
      {"bench picks", Group::kMeasure, "picks and places in free space, with noise and without",
       "prospect-picks-bench"},
      {"bench train", Group::kMeasure, "speed of each stage of training", "prospect-train-bench"},
  };
}

}  // namespace

const std::vector<Command>& Commands() {
  static const std::vector<Command> commands = Table();
  return commands;
}

const Command* FindCommand(std::string_view name) {
  for (const Command& command : Commands())
    if (command.name == name) return &command;
  return nullptr;
}

}  // namespace prospect::cli
