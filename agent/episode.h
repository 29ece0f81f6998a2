#pragma once

#include <optional>
#include <string>
#include <vector>

#include "agent/deliberation.h"
#include "agent/goal.h"
#include "agent/listener.h"
#include "agent/mind.h"
#include "agent/options.h"
#include "agent/record.h"
#include "agent/refusals.h"
#include "agent/world.h"

namespace prospect::agent {

/// One episode from the first look to the verdict: look, search, act on the first action of the
/// plan, look again, until the plan is complete, an action fails, or the search refuses. The
/// episode's first picture stays x0 of every search; the latest is x. With options.plan the actions
/// are simply carried out. Nothing is done where a safeguard objects or cannot be asked: whether
/// the picture is like known ones (options.novelty), and whether what is seen is what was imagined
/// (options.surprise). The same code runs wherever there are a World and a Mind. One thread; use
/// once; world, mind and listener must outlive it.
class Episode {
 public:
  /// @param mind null only with options.plan: nothing is searched then
  /// Throws std::invalid_argument when options.goal is no goal.
  Episode(World& world, Mind* mind, const EpisodeOptions& options, Listener& listener);

  /// Runs to the end. A goal that the task or the scene cannot have is refused before anything is
  /// searched. Throws UsageError, PromiseError, and what world and mind throw: Stopped() tells of
  /// the episode then.
  EpisodeRecord Run();

  /// After Run() threw: the episode as far as it came, "stopped" for this reason. What was carried
  /// out is told even so.
  EpisodeRecord Stopped(const std::string& reason);

 private:
  void Prepare();
  void LearnScene();
  void RunSearches();
  void FollowBlindly(const planner::Path& plan);
  void RunGivenPlan();
  bool Act(int action);
  ActionResult CarryOut(int action);
  bool GoesOn(const ActionResult& result);
  bool GoalReached() const;
  void FirstSearched(const SearchRecord& search);
  void FinishExplanation(const SearchRecord& search);
  void ExplainUnsearched();
  EpisodeRecord Conclude();
  void Verdict(const std::string& outcome, const std::string& reason);
  void TellOf(const ActRecord& act) const;

  World& world_;
  Mind* mind_;
  EpisodeOptions options_;
  Listener& listener_;
  EpisodeGoal goal_;
  EpisodeRecord record_;
  Glimpse first_, latest_;
  planner::Path what_if_;                     // empty: nothing was asked
  std::optional<Refusals> refusals_;          // with a mind
  std::optional<Deliberation> deliberation_;  // where plans are searched
  std::size_t given_steps_ = 0;               // of a plan that was not searched
};

}  // namespace prospect::agent
