#pragma once

#include <string>
#include <vector>

#include "model/trial.h"
#include "sim/task.h"

namespace prospect::tools {

// What a data set's actions are called and what may follow what. Data sets hold numbers; names come
// from the task that they were recorded with.
class ActionTable {
 public:
  // Of that task's table; null: numbers must do.
  explicit ActionTable(const sim::TaskSpec* spec);

  std::string Name(int action) const;
  bool KnowsRetries() const { return !successors_.empty(); }
  // Whether the trial goes back to try again (sim::IsRetry).
  bool HasRetry(const model::Trial& trial) const;

 private:
  std::vector<std::string> names_;
  std::vector<std::vector<int>> successors_;
};

}  // namespace prospect::tools
