#include "planner/search_parameters.h"

#include <stdexcept>

#include "planner/path.h"
#include "planner/selection_rule.h"

namespace prospect::planner {
namespace {

void Require(bool holds, const char* what) {
  if (!holds) throw std::invalid_argument(std::string("search parameters: ") + what);
}

constexpr double kCertainFailure = 0.01;

bool InUnit(double x) { return x >= 0 && x <= 1; }

}  // namespace

void SearchParameters::UseRule(const std::string& name) {
  const SearchParameters defaults;
  const bool uncut = MakeSelectionRule(name, c, c_puct)->asks_for_open();
  rule = name;
  if (c_done == defaults.c_done || c_done == kCertainFailure)
    c_done = uncut ? kCertainFailure : defaults.c_done;
  if (v_failed == defaults.v_failed || v_failed == 0) v_failed = uncut ? 0 : defaults.v_failed;
}

void SearchParameters::Validate() const {
  Require(c > 0 && c < 1e6, "c must be above 0 and below 1e6");
  Require(c_puct > 0 && c_puct < 1e6, "c_puct must be above 0 and below 1e6");
  Require(InUnit(c_done), "c_done must be in [0, 1]");
  Require(InUnit(v_failed), "v_failed must be in [0, 1]");
  Require(InUnit(p_min), "p_min must be in [0, 1]");
  Require(InUnit(refusal_threshold), "refusal_threshold must be in [0, 1]");
  Require(samples >= 1 && samples <= 1'000'000'000, "samples must be 1 to 1e9");
  Require(workers >= 1, "workers must be at least 1");
  Require(depth >= 1 && depth <= kMaxPathLength, "depth must be 1 to 64");
  Require(deadline_us >= 0, "deadline_us must not be negative");
  Require(listed_futures >= 0, "listed_futures must not be negative");
  Require(patience_us > 0, "patience_us must be above 0");
  Require(collisions >= 0, "collisions must not be negative");
  MakeSelectionRule(rule, c, c_puct);
}

}  // namespace prospect::planner
