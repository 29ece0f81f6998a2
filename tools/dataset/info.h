#pragma once

#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "model/dataset.h"
#include "sim/task.h"

namespace prospect::tools {

// How long the segments of one action are, in simulated seconds.
struct SegmentLengths {
  std::string action;
  int count = 0;
  int succeeded = 0;
  double low = 0, median = 0, high = 0;  // 5th, 50th and 95th percentile
};

// What `prospect dataset info` shows.
struct DataSetInfo {
  model::DataSetSummary summary;
  std::vector<SegmentLengths> actions;  // in the order of the table; those that occur
  int retries = -1;                     // trials that try again; -1: not known of this task
};

// Reads all labels. `spec`: the table that the file was recorded with; null: not known. Throws
// model::DataError.
DataSetInfo Inspect(const model::TrialFile& file, const sim::TaskSpec* spec);

void PrintInfo(const DataSetInfo& info, std::FILE* out);

// Keys: task, world_version, part (of collect --shard: index, count and what else is said of the
// run; null: it is whole), trials, successes, failures (by cause), reasons, retries (null: not
// known), frames, segments, segments_succeeded, train, valid, test, width, height, num_actions,
// actions (a list: action, count, succeeded, seconds_p05, seconds_p50, seconds_p95).
nlohmann::json InfoJson(const DataSetInfo& info);

}  // namespace prospect::tools
