#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "planner/attempts.h"
#include "services/executive/action_runner.h"
#include "services/executive/conversation.h"
#include "services/executive/course.h"
#include "services/executive/episode_goal.h"
#include "services/executive/episode_record.h"
#include "services/executive/familiarity.h"
#include "services/executive/options.h"
#include "services/executive/predictions.h"
#include "services/executive/search_session.h"

namespace prospect::services {

/// One episode from the first look to the verdict: look, search, act on the first action of the
/// plan, look again, until the plan is complete, an action fails, or the search refuses. The
/// episode's first picture stays x0 of every search; the latest is x. Under the policies "plan" and
/// "collect" the actions are simply carried out. Nothing is done where a safeguard objects or
/// cannot be asked: whether the picture is like known ones (options.novelty), and whether what is
/// seen is what was imagined (options.surprise). One thread; use once; the conversation must
/// outlive it.
class Episode {
 public:
  /// One line for a person about what has just been done.
  using Tell = std::function<void(const std::string&)>;

  /// Throws std::invalid_argument when options.goal is no goal.
  Episode(Conversation& talk, const ExecutiveOptions& options, Tell tell);

  /// Runs to the end. A goal that the task or the scene cannot have is refused before anything is
  /// searched. Throws ExitError when services are missing or fall silent, when another executive
  /// holds the robot, or after a stop signal. What else may be thrown, such as by a message that
  /// does not fit the task, is a std::exception; the robot then stands still.
  EpisodeRecord Run();

  /// After Run() threw: the episode as far as it came, "stopped" for this reason. What was carried
  /// out is told even so.
  EpisodeRecord Stopped(const std::string& reason);

 private:
  void Prepare();
  void RunSearchPolicy();
  void BeginAttempts();
  void SetCourse(const SearchRecord& record);
  double SurpriseNow() const;
  bool HeedsSurprises() const;
  std::string Objection(const planner::NextStep& next);
  void RunFixedPlan(const std::vector<int>& plan);
  planner::NextStep Decide(SearchRecord* record);
  SearchRecord SearchOnce(const planner::Attempt& attempt, planner::Plan* plan);
  SearchQuestion MakeQuestion(const planner::Attempt& attempt) const;
  bool Act(int action);
  action_status_t CarryOut(int action);
  bool GoesOn(const action_status_t& status);
  void AddImagined(const planner::Plan& plan, SearchRecord* record);
  bool ToBeExplained() const;
  PlanContext Context() const;
  void AddExplanation(const SearchAnswer& answer, const SearchRecord& record);
  void FinishExplanation(const SearchRecord& record);
  void ExplainUnsearched(const std::string& reason);
  void NameScene(Explanation* explanation) const;
  void ChooseThreshold();
  void LearnWhatIsCovered();
  const model::CalibrationSample* Calibration() const;
  double OwnThreshold() const;
  void AddTerms();
  void AddConfidence(const SearchRecord& record);
  void NameWhatIf();
  std::vector<planner::Future> OtherFirstActions(const planner::Plan& plan) const;
  bool GoalReached() const;
  void PublishPlan(const SearchRecord& record);
  void Conclude();
  void Verdict(const std::string& outcome, const std::string& reason);
  std::string ActionName(int action) const;
  void TellOf(const ActRecord& act) const;
  void AddSeconds(const char* phase, std::chrono::steady_clock::time_point since);

  Conversation& talk_;
  ExecutiveOptions options_;
  Tell tell_;
  EpisodeGoal goal_;
  SearchSession session_;
  PredictionInbox predictions_;
  FamiliarityInbox familiarity_;
  ActionRunner actions_;
  EpisodeRecord record_;
  observation_t first_{};
  observation_t latest_{};
  model_info_t model_{};
  model::PromisedThreshold promised_;          // of options_.promise
  std::optional<planner::Attempts> attempts_;  // under policy "search"
  Course course_;                              // of the plan that is followed
  std::size_t given_steps_ = 0;                // of a plan that was not searched
  planner::Path what_if_;                      // empty: nothing was asked
};

/// A person's words for why a future was not chosen.
std::string WhyNot(const planner::Future& future, double chosen_score);

}  // namespace prospect::services
