#pragma once

#include <string>
#include <vector>

#include "base/child_process.h"
#include "services/executive/conversation.h"

namespace prospect::services {

/// The processes that a bench runs around itself: model servers and planner workers, on the bench's
/// own bus. More workers may join later. One thread; the conversation must outlive it.
class Crew {
 public:
  /// @param logs folder for the processes' output, made if it is not there
  Crew(Conversation& talk, const std::string& logs) : talk_(talk), logs_(logs) {}

  /// Starts model servers with these arguments (besides --bus) and waits until they are ready.
  /// @throws ExitError (kExitServiceLost) when they are not within 20 s
  void StartServers(int count, const std::vector<std::string>& arguments);

  /// Starts workers until there are `count`, and waits until they are ready. @throws as above
  void HaveWorkers(int count);

  /// Ends the latest worker without a word, as a crash would.
  void KillWorker() { workers_.pop_back(); }

  int workers() const { return static_cast<int>(workers_.size()); }

  /// Processor seconds used by servers, by workers.
  double ServerCpu();
  double WorkerCpu();

 private:
  void Await(const std::string& service, int count);
  /// A program of ours, on the bench's bus, what it says going to a log.
  base::ChildProcess Start(const std::string& program, const std::string& service,
                           const std::vector<std::string>& arguments);

  Conversation& talk_;
  std::string logs_;
  std::vector<base::ChildProcess> servers_, workers_;
  int started_ = 0;
};

}  // namespace prospect::services
