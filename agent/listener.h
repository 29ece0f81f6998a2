#pragma once

#include <string>

#include "agent/record.h"
#include "planner/plan.h"

namespace prospect::agent {

/// Who hears how an episode goes on. By default it leaves what it hears alone.
class Listener {
 public:
  virtual ~Listener() = default;

  /// A line for a person about what has just been done.
  virtual void Tell(const std::string& /*line*/) {}
  /// A line for the log.
  virtual void Note(const std::string& /*line*/) {}
  virtual void Warn(const std::string& /*line*/) {}
  /// A search is over: the record's next one, unless another decides.
  virtual void Searched(const SearchRecord& /*search*/, const planner::Plan& /*plan*/) {}
  /// The latest search, or what became of its plan, has changed.
  virtual void PlanChanged(const EpisodeRecord& /*record*/) {}
};

}  // namespace prospect::agent
