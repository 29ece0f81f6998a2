#include "services/binding/search_messages.h"

#include <algorithm>
#include <string>

namespace prospect::services {
namespace {

using planner::SearchParameters;

// The parameters that travel by name, in one table for both directions.
struct NamedParameter {
  const char* name;
  double SearchParameters::*field;
};
constexpr NamedParameter kNamed[] = {
    {"c", &SearchParameters::c},
    {"c_puct", &SearchParameters::c_puct},
    {"c_done", &SearchParameters::c_done},
    {"v_failed", &SearchParameters::v_failed},
    {"p_min", &SearchParameters::p_min},
    {"refusal_threshold", &SearchParameters::refusal_threshold},
};
constexpr char kWorkers[] = "workers";

// What is out of range becomes the nearest; a number of workers that is none, one.
int WorkersOf(const search_root_t& root) {
  const double workers = ParameterOr(root, kWorkers, 1);
  return workers > 1 ? static_cast<int>(std::min(workers, 2147483647.0)) : 1;
}

void Add(const char* name, double value, search_root_t* root) {
  root->parameter_names.emplace_back(name);
  root->parameter_values.push_back(value);
}

}  // namespace

void SetParameters(const SearchParameters& parameters, search_root_t* root) {
  root->rule = parameters.rule;
  root->parameter_names.clear();
  root->parameter_values.clear();
  for (const auto& named : kNamed) Add(named.name, parameters.*named.field, root);
  root->sharing = parameters.sharing ? 1 : 0;
  Add(kWorkers, parameters.workers, root);
  root->num_parameters = static_cast<std::int32_t>(root->parameter_names.size());
  root->depth = parameters.depth;
  root->samples = static_cast<std::int32_t>(parameters.samples);
  root->seed = static_cast<std::int64_t>(parameters.seed);
}

double ParameterOr(const search_root_t& root, const char* name, double otherwise) {
  for (std::size_t i = 0; i < root.parameter_names.size(); ++i) {
    if (root.parameter_names[i] == name) return root.parameter_values[i];
  }
  return otherwise;
}

SearchParameters ParametersFrom(const search_root_t& root, std::int64_t now_us) {
  SearchParameters parameters;
  parameters.rule = root.rule;
  for (const auto& named : kNamed) {
    parameters.*named.field = ParameterOr(root, named.name, parameters.*named.field);
  }
  parameters.sharing = root.sharing != 0;
  parameters.workers = WorkersOf(root);
  parameters.depth = root.depth;
  parameters.samples = root.samples;
  parameters.seed = static_cast<std::uint64_t>(root.seed);
  parameters.deadline_us = root.budget_ms < 0 ? 0 : now_us + root.budget_ms * 1000;
  return parameters;
}

planner::SearchId SearchIdFrom(const search_root_t& root) {
  return {static_cast<std::uint64_t>(root.search_id), static_cast<std::uint32_t>(root.epoch)};
}

planner::Path ExecutedFrom(const search_root_t& root) { return root.executed; }

}  // namespace prospect::services
