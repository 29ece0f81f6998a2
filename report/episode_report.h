#pragma once

#include <string>

#include "agent/record.h"

namespace prospect::report {

// What an episode leaves behind for people and scripts. Pure functions of the record.

/// The plan as a table: step, action, score, V, f, visits, predicted and observed outcome; then the
/// verdict in words.
std::string PlanTable(const agent::EpisodeRecord& record);

/// result.json: task, seed (null: no simulated scene), outcome, reason, actions, rollouts,
/// evaluations, seconds by phase, steps, searches; confidence (null where no plan was to be carried
/// out, or no calibration scene scored alike), refusals and novelty where they are known.
/// @param exit_code of the program, so that a script reading only the file knows it
std::string ResultJson(const agent::EpisodeRecord& record, int exit_code);

/// The verdict in one sentence for a person.
std::string VerdictSentence(const agent::EpisodeRecord& record);

/// One row of the table: the step as imagined in the search just before it, or, where no action was
/// made any more, in the last search.
struct TableRow {
  int step = 0;  // from 1
  agent::StepRecord imagined;
  bool searched = false;  // false under the policies that search nothing
  std::string observed;   // empty: not carried out
  std::string note{};     // what was not as usual about the search before it; empty: nothing
};
std::vector<TableRow> TableRows(const agent::EpisodeRecord& record);

}  // namespace prospect::report
