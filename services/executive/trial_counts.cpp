#include "services/executive/trial_counts.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "agent/world.h"
#include "base/atomic_file.h"
#include "base/exit_error.h"
#include "base/hash.h"
#include "services/binding/task_messages.h"

namespace prospect::services {

TrialCounts::TrialCounts(const std::string& path, const task_t& task, std::int64_t first_seed)
    : path_(path),
      task_(task.name),
      task_hash_(base::HexText(TaskHash(task))),
      first_seed_(first_seed) {
  for (const action_t& action : task.actions) rows_.push_back({action.name});
  if (!std::filesystem::exists(path_)) return;
  std::ifstream file(path_);
  try {
    Read(nlohmann::json::parse(file));
  } catch (const nlohmann::json::exception&) {
    throw ExitError(kExitDataFile, path_ + " does not count trials: remove it");
  }
}

void TrialCounts::Read(const nlohmann::json& file) {
  if (file.at("task_hash") != task_hash_)
    throw ExitError(kExitUsage, path_ + " counts trials of another action table (" +
                                    file.at("task").get<std::string>() + "): choose another --out");
  if (file.at("first_seed") != first_seed_)
    throw ExitError(kExitUsage, path_ + " counts trials from --seed " +
                                    std::to_string(file.at("first_seed").get<std::int64_t>()) +
                                    " on: give that, or choose another --out");
  episodes_ = file.at("episodes");
  file.at("outcomes").get_to(outcomes_);
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    rows_[i].tried = file.at("actions").at(i).at("tried");
    rows_[i].succeeded = file.at("actions").at(i).at("succeeded");
  }
}

void TrialCounts::Add(const agent::EpisodeRecord& record) {
  ++episodes_;
  ++outcomes_[record.outcome];
  for (const agent::ActRecord& act : record.acts) {
    Row& row = rows_.at(static_cast<std::size_t>(act.action));
    ++row.tried;
    if (act.observed == agent::ToString(agent::ActionState::kSucceeded)) ++row.succeeded;
  }
}

void TrialCounts::Write() const { base::WriteFile(path_, ToJson().dump(2) + "\n"); }

std::int64_t TrialCounts::solved() const {
  const auto found = outcomes_.find("solved");
  return found == outcomes_.end() ? 0 : found->second;
}

nlohmann::json TrialCounts::ToJson() const {
  nlohmann::json file = {
      {"task", task_},         {"task_hash", task_hash_}, {"first_seed", first_seed_},
      {"episodes", episodes_}, {"outcomes", outcomes_},   {"actions", nlohmann::json::array()}};
  for (const Row& row : rows_)
    file["actions"].push_back(
        {{"name", row.name}, {"tried", row.tried}, {"succeeded", row.succeeded}});
  return file;
}

std::string TrialCounts::Table() const {
  std::size_t width = 6;
  for (const Row& row : rows_) width = std::max(width, row.name.size());
  const auto line = [&](const std::string& name, const std::string& tried,
                        const std::string& succeeded) {
    char text[64];
    std::snprintf(text, sizeof text, " %9s %9s\n", tried.c_str(), succeeded.c_str());
    return name + std::string(width - name.size(), ' ') + text;
  };
  std::string table = line("action", "tried", "succeeded");
  for (const Row& row : rows_)
    table += line(row.name, std::to_string(row.tried), std::to_string(row.succeeded));
  return table;
}

}  // namespace prospect::services
