#pragma once

#include <string>
#include <vector>

#include "model/trial.h"

namespace prospect::tools {

// What a data set's actions are called and what may follow what. Data sets hold numbers; names come
// from the task of that name if it is one of ours and its table is the file's.
class ActionTable {
 public:
  // Of the task that `trial` names; without names if that is not one of ours.
  explicit ActionTable(const model::Trial& trial);

  std::string Name(int action) const;
  bool KnowsRetries() const { return !successors_.empty(); }
  // Whether the trial goes back to try again (sim::IsRetry).
  bool HasRetry(const model::Trial& trial) const;

 private:
  std::vector<std::string> names_;
  std::vector<std::vector<int>> successors_;
};

}  // namespace prospect::tools
