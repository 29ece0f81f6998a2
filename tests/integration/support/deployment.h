#pragma once

#include <list>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/integration/support/process.h"
#include "tests/integration/support/witness.h"

namespace prospect::tests {

/// The real programs of one deployment with the scripted engine, their logs in a folder of the
/// test's own. All seven objects stand on the site, because the scripted engine knows nothing of
/// what the camera sees.
class Deployment {
 public:
  explicit Deployment(const std::string& test_name) : folder(MakeFolder(test_name)) {}

  Process& Simulator(const std::vector<std::string>& more = {});
  Process& ModelServer(const std::vector<std::string>& more = {});
  Process& Worker(const std::vector<std::string>& more = {});
  /// An executive for `seed` with results in folder/out.
  Process& Executive(const std::vector<std::string>& more = {}, int seed = 1500000);

  /// Lets go of a process that has ended, so that a long test does not gather them.
  void Forget(const Process& process);

  /// Simulator, model server and `workers` workers, and waits until they are ready. @return whether
  /// they are
  bool Up(Witness& witness, int workers, const std::vector<std::string>& simulator = {});

  nlohmann::json Result() const {
    return nlohmann::json::parse(ReadText(folder + "/out/result.json"));
  }
  std::string Log(const std::string& name) const { return ReadText(folder + "/" + name + ".log"); }

  const std::string folder;

 private:
  Process& Start(const std::string& program, std::vector<std::string> arguments,
                 const std::vector<std::string>& more);

  std::list<Process> processes_;
  int started_ = 0;
};

}  // namespace prospect::tests
