#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "agent/course.h"
#include "agent/goal.h"
#include "agent/listener.h"
#include "agent/mind.h"
#include "agent/options.h"
#include "agent/plan_context.h"
#include "agent/record.h"
#include "agent/refusals.h"
#include "agent/task_view.h"
#include "planner/attempts.h"

namespace prospect::agent {

/// Decides what to do next, from one picture to the next, over one episode: searches, begins a lost
/// plan anew, and heeds the safeguards, each of which has to be asked and not to object. The
/// episode's first picture stays x0 of every search; the latest is x. One thread; all that it is
/// given must outlive it.
class Deliberation {
 public:
  /// @param what_if a plan to be judged beside the first search's; empty: none
  /// @param record gets what is explained, the word on the first picture, seconds and counts
  Deliberation(Mind& mind, const TaskView& task, const EpisodeGoal& goal,
               const EpisodeOptions& options, const Refusals& refusals, planner::Path what_if,
               Listener& listener, EpisodeRecord* record);

  /// What to do now. `search` tells of the search that decided; of two, the other is told in its
  /// note. Throws what the mind throws.
  planner::NextStep Decide(const Glimpse& first, const Glimpse& present, SearchRecord* search);

  /// `action` was carried out.
  void CarriedOut(int action) { attempts_.CarriedOut(action); }

  const planner::Attempts& attempts() const { return attempts_; }

 private:
  SearchRecord SearchOnce(const planner::Attempt& attempt, const Glimpse& first,
                          const Glimpse& present, planner::Plan* plan);
  SearchQuestion QuestionFor(const planner::Attempt& attempt, const Glimpse& first,
                             const Glimpse& present) const;
  bool FirstOfAll() const { return record_->searches.empty(); }
  void Explain(const SearchAnswer& answer, const PlanContext& context);
  void AddPictures(const planner::Plan& plan, SearchRecord* search);
  void SetCourse(SearchRecord* search);
  bool HeedsSurprises() const;
  std::string Objection(const planner::NextStep& next, const Glimpse& present);
  std::string UnknownPicture(bool acts);

  Mind& mind_;
  const TaskView& task_;
  const EpisodeOptions& options_;
  const Refusals& refusals_;
  Listener& listener_;
  EpisodeRecord* record_;
  planner::Path what_if_;
  std::vector<std::string> goal_;
  planner::TaskRules rules_;  // with the goal
  planner::Attempts attempts_;
  Course course_;  // of the plan that is followed
};

}  // namespace prospect::agent
