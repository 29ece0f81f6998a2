#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace prospect::tools {

// What one scene gave: its class by the oracle, and a record for each row (planner, nothing,
// random, greedy, exhaustive, simulator_model). JSON, because it crosses a process boundary and
// ends in the report file as it is:
//   {seed, class, oracle_success, solved_at_start, rows: {NAME: {ending, reason, actions, score,
//   evaluations, rollouts, seconds}}}
using SceneRecord = nlohmann::json;

// The figures over all scenes, with the keys that docs/json.md documents. Scenes solved by doing
// nothing are left out.
nlohmann::json Summarise(const std::vector<SceneRecord>& scenes,
                         const std::vector<std::string>& rows);

// The same of scenes that nobody has classed, as on a bus: without the keys that take an oracle.
nlohmann::json SummariseUnclassed(const std::vector<SceneRecord>& scenes,
                                  const std::vector<std::string>& rows);
std::string UnclassedTable(const nlohmann::json& summary, const std::vector<std::string>& rows);

// The summary as a table for a person.
std::string Table(const nlohmann::json& summary, const std::vector<std::string>& rows);

}  // namespace prospect::tools
