#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/integration/support/process.h"
#include "tests/integration/support/witness.h"

namespace prospect::tests {

/// Simulator, scripted model server and planner workers under prospect-supervisor, as
/// `./prospect up` starts them. One thread.
class Supervised {
 public:
  explicit Supervised(const std::string& test_name) : folder(MakeFolder(test_name)) {}

  struct Options {
    int workers = 2;
    std::string weights = "scripted:7";
    std::string chaos;                   ///< as --chaos takes it
    std::vector<std::string> simulator;  ///< further options of the simulator
  };

  /// @param log its name in `folder`, without .log
  Process Start(const Options& options, const std::string& log = "supervisor",
                const std::vector<std::string>& more = {});

  /// Waits until all are ready. @return whether they are
  bool AllReady(int workers);

  /// Service name -> what services.json says of it.
  std::map<std::string, nlohmann::json> Services() const;
  int PidOf(const std::string& name) const;
  std::vector<int> Pids() const;

  /// Waits for a sign of life of a process other than `old_pid` that the supervisor runs as `name`.
  bool BackWithin(const std::string& name, int old_pid, int milliseconds);

  Witness witness;
  const std::string folder;  ///< of the state file and the logs
};

}  // namespace prospect::tests
