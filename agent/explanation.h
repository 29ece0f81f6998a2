#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "agent/confidence.h"
#include "agent/familiarity.h"
#include "agent/picture.h"
#include "agent/plan_context.h"
#include "planner/plan.h"
#include "planner/search_parameters.h"

namespace prospect::agent {

// Why a search answered as it did, for a person: which plan it chose, which others came close and
// what each lost by, with the numbers it was judged by. Plain data and pure functions of what the
// search knew; others show it.

/// One imagined step.
struct ExplainedStep {
  int action = -1;
  std::string name;
  bool imagined = true;  // false: ruled out before it was imagined, so it has p at most
  double value = 0;      // V after it
  double done = 0;       // f
  double prior = 0;      // p, seen from the state before it; negative: not known
  double score = 0;      // V here times f of all steps so far
  Picture picture;       // what the world is expected to look like; empty: could not be had
};

struct ExplainedPlan {
  std::vector<ExplainedStep> steps;
  double score = 0;         // V at the end times f along the path; 0 where the end is not imagined
  std::int64_t visits = 0;  // rollouts that came to its end
  bool to_its_end = false;  // followed as far as the search looks
  int shared = 0;           // leading steps that the chosen plan has, too
  int given_up = 0;         // the step, from 1, at which it was given up; 0: at none
  std::string why;          // one sentence or two: what it lost by, with numbers
};

/// What the model expects of a plan that a person named.
struct WhatIf {
  ExplainedPlan plan;
  int forbidden = 0;  // the step, from 1, that the task's rules forbid; 0: none
  /// In words: what the search would give it up for, and how it stands against the chosen plan.
  std::vector<std::string> findings;
};

struct Explanation {
  std::string task;
  std::int64_t seed = -1;  // of the simulated scene; -1: there is none, or nobody said it
  std::string weights;     // hash, hexadecimal
  std::string engine;
  std::vector<std::string> goal;  // atoms; none: the task's own goal
  Picture seen;                   // what the camera sees

  bool act = false;
  std::string reason;     // of a refusal
  double score = 0;       // of `chosen`
  double root_value = 0;  // V of the scene as it is
  int plan_length = 0;    // actions that are left of a whole plan
  ExplainedPlan chosen;   // the plan; of a refusal the best of the bad ones, which may be empty
  std::vector<ExplainedPlan> alternatives;  // the best first
  std::vector<std::string> ruled_out;  // first actions that were never imagined, each with its p
  std::vector<std::string> untried;    // first actions of which no future was followed to its end
  std::optional<WhatIf> what_if;
  std::optional<Familiarity> familiarity;  // of the picture; none: nobody knows
  std::optional<Confidence> confidence;    // in the chosen plan; none: it is not to be had
  std::optional<RefusalTerms> terms;       // none: the weights carry no calibration sample
  std::string not_covered;                 // why theirs says nothing of such scenes; empty: it does

  planner::SearchParameters parameters;  // with the refusal threshold
  std::string ended_by;                  // empty: refused before anything was searched
  std::int64_t rollouts = 0;
  std::int64_t evaluations = 0;
  int workers = 0;
  double seconds = 0;
};

/// "scene 2000000", or "the scene as it stood" where no seed is known.
std::string SceneWords(std::int64_t seed);

/// The most alternatives that are shown.
inline constexpr int kAlternatives = 5;

/// The answer and the best that it was chosen over: the best of all, the best of every other first
/// action, then the best of every other way to part from the chosen plan. Pictures, and what only
/// the process knows (task, weights, counts), are the caller's to fill in.
Explanation Explain(const planner::Plan& plan, const PlanContext& context);

/// One imagined step, or one that was not.
ExplainedStep StepOf(const planner::PlanStep& step, bool imagined, const PlanContext& context);

/// Every state that has a picture in the explanation, each once.
std::set<planner::Path> StatesShown(const Explanation& explanation);
void SetPictures(const std::map<planner::Path, Picture>& pictures, Explanation* explanation);

}  // namespace prospect::agent
