#pragma once

#include <list>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/faults/search_observer.h"
#include "tests/integration/support/process.h"
#include "tests/integration/support/witness.h"

namespace prospect::tests {

/// One long search by the real programs, and who watches it: for tests and measurements that kill
/// processes in the middle of it. The tree is the scripted one, large enough never to be known; who
/// asks is fault-asker, with the executive's own library. One thread.
class WatchedSearch {
 public:
  explicit WatchedSearch(const std::string& name);

  /// A model server whose batches take 5 ms whatever their rows, so that rollouts wait for
  /// evaluations and cost little processor time.
  Process& Server();
  Process& Worker() { return workers_.emplace_back(Program("prospect-worker", {})); }

  /// Waits until all that is named lives. @return whether it does
  bool Up(int servers, int workers);

  /// Begins one search as long as `budget_ms` allows.
  Process& Begin(int workers, int budget_ms);
  /// Waits until rollouts are being made. @return whether they are
  bool UnderWay();
  /// Waits for the search's end. @return what the asker says of it; null when it failed
  nlohmann::json End();

  /// Instance id of a live process, by what it is and its process id; 0 when it was not heard.
  std::int64_t IdOf(const std::string& service, int pid) const;

  Witness witness;
  SearchObserver observer{witness.bus};
  const std::string folder;  ///< of the programs' logs

 private:
  Process Program(const std::string& name, const std::vector<std::string>& arguments);

  std::list<Process> servers_, workers_;
  std::unique_ptr<Process> asker_;
  std::string answer_log_;
  int started_ = 0;
};

}  // namespace prospect::tests
