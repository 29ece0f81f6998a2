#include "report/episode_report.h"

#include <cstdio>
#include <nlohmann/json.hpp>

namespace prospect::report {

using namespace agent;

namespace {

using nlohmann::json;

json StepJson(const TableRow& row) {
  json step = {{"step", row.step}, {"action", row.imagined.action}, {"name", row.imagined.name}};
  if (row.searched) {
    step["score"] = row.imagined.score;
    step["V"] = row.imagined.value;
    step["f"] = row.imagined.done;
    step["visits"] = row.imagined.visits;
    step["predicted"] = row.imagined.predicted ? "success" : "failure";
  }
  step["observed"] = row.observed.empty() ? json(nullptr) : json(row.observed);
  return step;
}

json FutureJson(const FutureRecord& future) {
  return {{"actions", future.names}, {"score", future.score},   {"V", future.value},
          {"f", future.done},        {"visits", future.visits}, {"why", future.why}};
}

json SearchJson(const SearchRecord& search) {
  json result = {{"decision", search.act ? "act" : "refuse"},
                 {"reason", search.reason},
                 {"ended_by", search.ended_by},
                 {"score", search.score},
                 {"threshold", search.threshold},
                 {"root_value", search.root_value},
                 {"rollouts", search.rollouts},
                 {"overshoot", search.overshoot},
                 {"evaluations", search.evaluations},
                 {"evaluations_requested", search.requested},
                 {"workers", search.workers},
                 {"converged", search.converged},
                 {"table", search.table},
                 {"seconds", search.seconds}};
  if (!search.note.empty()) result["note"] = search.note;
  for (const auto& step : search.steps) result["plan"].push_back(step.name);
  for (const auto& other : search.others) result["others"].push_back(FutureJson(other));
  return result;
}

json WhatIfJson(const WhatIf& what_if) {
  json result = {{"findings", what_if.findings},
                 {"steps", json::array()},
                 {"forbidden_step", what_if.forbidden},
                 {"given_up_at_step", what_if.plan.given_up},
                 {"score", what_if.plan.score}};
  for (const auto& step : what_if.plan.steps) {
    json shown = {{"name", step.name}, {"imagined", step.imagined}};
    if (step.imagined) {
      shown["V"] = step.value;
      shown["f"] = step.done;
      shown["p"] = step.prior;
      shown["score"] = step.score;
    }
    result["steps"].push_back(shown);
  }
  return result;
}

json ConfidenceJson(const Confidence& confidence) {
  return {{"success", confidence.share()},
          {"scenes", confidence.scenes},
          {"solved", confidence.solved},
          {"scores", {confidence.low, confidence.high}}};
}

json TermsJson(const RefusalTerms& terms) {
  return {
      {"calibration_scenes", terms.sample}, {"promises", terms.promises}, {"caveat", terms.caveat}};
}

// What calibration scenes say of the plan that was begun, and of refusals.
std::string ConfidenceLines(const EpisodeRecord& record) {
  if (!record.not_covered.empty()) return record.not_covered + '\n';
  std::string text = record.confidence ? "At the start: " : "";
  for (const auto& sentence : ConfidenceSentences(record.confidence, record.terms))
    text += sentence + '\n';
  return record.terms ? text + record.terms->table : text;
}

json NoveltyJson(const Familiarity& familiarity) {
  const model::Novelty& novelty = familiarity.novelty;
  return {{"p", novelty.p},
          {"level", familiarity.level},
          {"unlike", familiarity.foreign()},
          {"error", novelty.error},
          {"error_limit", novelty.error_limit},
          {"residual", novelty.residual},
          {"residual_limit", novelty.residual_limit},
          {"state", novelty.state},
          {"state_limit", novelty.state_limit}};
}

json ActJson(const ActRecord& act) {
  return {{"action", act.action},
          {"name", act.name},
          {"observed", act.observed},
          {"reason", act.reason},
          {"sim_seconds", act.sim_seconds}};
}

std::string FormatRow(const TableRow& row) {
  char text[160];
  const std::string observed = row.observed.empty() ? "-" : row.observed;
  if (!row.searched) {
    std::snprintf(text, sizeof text, "%4d  %-24s %7s %7s %7s %7s  %-9s  %s\n", row.step,
                  row.imagined.name.c_str(), "-", "-", "-", "-", "-", observed.c_str());
    return text;
  }
  std::snprintf(text, sizeof text, "%4d  %-24s %7.3f %7.3f %7.3f %7lld  %-9s  %s\n", row.step,
                row.imagined.name.c_str(), row.imagined.score, row.imagined.value,
                row.imagined.done, static_cast<long long>(row.imagined.visits),
                row.imagined.predicted ? "succeeds" : "fails", observed.c_str());
  return text;
}

}  // namespace

std::vector<TableRow> TableRows(const EpisodeRecord& record) {
  std::vector<TableRow> rows;
  for (std::size_t i = 0; i < record.acts.size(); ++i) {
    TableRow row;
    row.step = static_cast<int>(i) + 1;
    row.searched = i < record.searches.size() && !record.searches[i].steps.empty();
    if (row.searched) row.imagined = record.searches[i].steps.front();
    row.imagined.action = record.acts[i].action;
    row.imagined.name = record.acts[i].name;
    row.observed = record.acts[i].observed;
    if (i < record.searches.size()) row.note = record.searches[i].note;
    rows.push_back(row);
  }
  // What was imagined and not carried out: all that a refusal looked at, or what an untimely end
  // left of the plan.
  if (record.searches.empty()) return rows;
  const auto& last = record.searches.back().steps;
  const bool refused = record.searches.size() > record.acts.size();
  for (std::size_t i = refused ? 0 : 1; i < last.size(); ++i) {
    rows.push_back({static_cast<int>(rows.size()) + 1, last[i], true, ""});
  }
  return rows;
}

std::string VerdictSentence(const EpisodeRecord& record) {
  const std::string steps = std::to_string(record.acts.size());
  if (record.outcome == "solved") return "Solved: all " + steps + " actions succeeded.";
  if (record.outcome == "refused") return "Refused, nothing was done: " + record.reason;
  if (record.outcome == "explained") return "A plan was found; nothing was carried out.";
  if (record.outcome == "stopped") return "Stopped after " + steps + " actions: " + record.reason;
  return "Failed: " + record.reason;
}

std::string PlanTable(const EpisodeRecord& record) {
  const auto rows = TableRows(record);
  std::string text =
      rows.empty()
          ? ""
          : "Step  Action                     Score       V       f  Visits  Predicted  Observed\n";
  for (const auto& row : rows) {
    if (!row.note.empty()) text += "      " + row.note + '\n';
    text += FormatRow(row);
  }
  text += VerdictSentence(record) + '\n';
  for (const auto& atom : record.goal)
    text += (&atom == &record.goal.front() ? "Goal: " : ", ") + atom;
  if (!record.goal.empty()) text += '\n';
  text += ConfidenceLines(record);
  if (record.searches.empty()) return text;
  std::int64_t rollouts = 0, evaluations = 0;
  for (const auto& search : record.searches)
    rollouts += search.rollouts, evaluations += search.evaluations;
  char line[200];
  const auto seconds = record.phase_seconds.find("search");
  std::snprintf(line, sizeof line, "%zu %s: %lld rollouts, %lld imagined states, %.2f s.\n",
                record.searches.size(), record.searches.size() == 1 ? "search" : "searches",
                static_cast<long long>(rollouts), static_cast<long long>(evaluations),
                seconds == record.phase_seconds.end() ? 0.0 : seconds->second);
  return text + line;
}

std::string ResultJson(const EpisodeRecord& record, int exit_code) {
  json result = {{"task", record.task},
                 {"world_version", record.world_version},
                 {"seed", record.seed < 0 ? json(nullptr) : json(record.seed)},
                 {"policy", record.policy},
                 {"goal", record.goal},
                 {"objects", record.objects},
                 {"plan_length", record.plan_length},
                 {"weights_hash", record.weights},
                 {"engine", record.engine},
                 {"not_covered", record.not_covered},
                 {"outcome", record.outcome},
                 {"reason", record.reason},
                 {"exit_code", exit_code},
                 {"seconds", record.phase_seconds},
                 {"frames", record.frames.size()}};
  std::int64_t rollouts = 0, evaluations = 0;
  for (const auto& search : record.searches)
    rollouts += search.rollouts, evaluations += search.evaluations;
  result["rollouts"] = rollouts;
  result["evaluations"] = evaluations;
  for (const char* list : {"actions", "steps", "acts", "searches"}) result[list] = json::array();
  for (const auto& act : record.acts) {
    result["actions"].push_back(act.name);
    result["acts"].push_back(ActJson(act));
  }
  for (const auto& row : TableRows(record)) result["steps"].push_back(StepJson(row));
  for (const auto& search : record.searches) result["searches"].push_back(SearchJson(search));
  if (record.explanation && record.explanation->what_if)
    result["what_if"] = WhatIfJson(*record.explanation->what_if);
  result["confidence"] = record.confidence ? ConfidenceJson(*record.confidence) : json(nullptr);
  if (record.terms) result["refusals"] = TermsJson(*record.terms);
  if (record.familiarity) result["novelty"] = NoveltyJson(*record.familiarity);
  // Names and reasons come over the bus: what is no UTF-8 is replaced, and ends no episode.
  return result.dump(2, ' ', false, json::error_handler_t::replace) + '\n';
}

}  // namespace prospect::report
