#pragma once

#include <string>

#include "agent/record.h"

namespace prospect::report {

inline agent::StepRecord Step(const std::string& name, double score) {
  agent::StepRecord step;
  step.action = 1;
  step.name = name;
  step.score = score;
  step.value = 0.9;
  step.done = 0.8;
  step.visits = 12;
  step.predicted = true;
  return step;
}

// Two steps planned, the first carried out, the second failed after a new search.
inline agent::EpisodeRecord FailedEpisode() {
  agent::EpisodeRecord record;
  record.task = "navigation";
  record.seed = 5;
  record.outcome = "failed";
  record.reason = "b failed: it ran out of time";
  agent::SearchRecord first, second;
  first.act = second.act = true;
  first.rollouts = 30;
  second.rollouts = 20;
  first.steps = {Step("a", 0.7), Step("c", 0.6), Step("d", 0.5)};
  second.steps = {Step("b", 0.4), Step("d", 0.3)};
  record.searches = {first, second};
  agent::ActRecord a, b;
  a.name = "a";
  a.observed = "succeeded";
  b.name = "b";
  b.observed = "failed";
  b.reason = "time";
  record.acts = {a, b};
  return record;
}

}  // namespace prospect::report
