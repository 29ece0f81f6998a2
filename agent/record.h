#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "agent/explanation.h"
#include "agent/familiarity.h"
#include "agent/picture.h"
#include "planner/attempts.h"

namespace prospect::agent {

// What one episode was, for people and files: plain data, filled by Episode, read by everything
// that reports.

/// One imagined step of a plan.
struct StepRecord {
  int action = -1;
  std::string name;
  double score = 0;         // V here times f along the path up to here
  double value = 0;         // V
  double done = 0;          // f
  std::int64_t visits = 0;  // N
  bool predicted = false;   // imagined to succeed
  Picture imagined;         // the predicted picture; empty when it could not be had
};

/// A future that was not chosen.
struct FutureRecord {
  std::vector<std::string> names;
  double score = 0;
  double value = 0;
  double done = 0;
  std::int64_t visits = 0;
  bool rejected =
      false;         // given up; false: it could have been carried out, but another one was better
  std::string why;   // one short sentence
  Picture imagined;  // after its first action
};

/// One search and its answer.
struct SearchRecord {
  bool act = false;              // false: refused
  std::string reason;            // of a refusal
  std::string ended_by;          // "samples", "exhausted", "deadline", ...
  double score = 0;              // of the whole plan
  double threshold = 0;          // plans below it are refused
  double root_value = 0;         // V of the scene as it was
  std::int64_t rollouts = 0;     // of all workers
  std::int64_t overshoot = 0;    // rollouts beyond the budget
  std::int64_t evaluations = 0;  // distinct paths evaluated
  std::int64_t requested = 0;    // evaluations that workers asked for, summed over workers
  int workers = 0;
  std::int64_t search_id = 0;
  std::int32_t epoch = 0;
  planner::NextStep::Kind kind = planner::NextStep::Kind::kGiveUp;  // what was decided by it
  double surprise = 0;  // of what was seen when it was decided; 0: nothing was imagined for then
  double decision_seconds = 0;  // wall clock, from the picture to the decision
  std::string note;        // what is not as usual: "begins anew", "the plan is lost"; else empty
  std::string table;       // TableHash of all that was known, 16 hexadecimal digits
  bool converged = false;  // every live worker's final rows were heard
  double seconds = 0;
  std::vector<StepRecord> steps;
  std::vector<FutureRecord> others;  // first actions that were not chosen
};

/// One action as it was carried out.
struct ActRecord {
  int action = -1;
  std::string name;
  std::string observed;    // "succeeded", "failed", "cancelled"
  std::string reason;      // of a failure
  double sim_seconds = 0;  // simulated time it took
  Picture picture;         // what the camera saw when it ended
};

struct EpisodeRecord {
  std::string task;
  std::string world_version;
  std::int64_t seed = -1;  // of the simulated scene; -1: there is none, or nobody said it
  std::string policy;
  std::vector<std::string> goal;  // atoms; none: the task's own
  int objects = 0;
  int plan_length = 0;
  std::string weights;  // hash, hexadecimal
  std::string engine;
  // "solved", "refused", "stopped", "failed"; "explained": a plan was found, and not carried out
  std::string outcome;
  std::string reason;  // empty when solved
  Picture first;       // what the camera saw at the start
  std::int64_t rollouts = 0,
               evaluations = 0;        // of all searches, also of those that decided nothing
  std::vector<SearchRecord> searches;  // one before each action, under policy "search"
  std::vector<ActRecord> acts;
  std::optional<Explanation> explanation;  // of the first search, where it was asked for
  std::optional<Confidence> confidence;    // in the first search's plan; none: not to be had
  std::optional<RefusalTerms> terms;       // none: nothing was searched, or no calibration
  std::string not_covered;  // why the weights' calibration says nothing here; empty: it does
  std::optional<Familiarity> familiarity;       // of the first picture; none: nobody knows
  std::map<std::string, double> phase_seconds;  // "services", "look", "search", "pictures", "act"
  std::vector<Picture> frames;    // every picture of the episode that was heard, in order
  double frames_per_second = 10;  // of simulated time
};

/// What an explanation says of the scene it is about.
void NameScene(const EpisodeRecord& record, Explanation* explanation);

}  // namespace prospect::agent
