#pragma once

#include <gtest/gtest.h>

#include "model/trial.h"
#include "tasks/task_file.h"

namespace prospect::tools {

/// Two bins and a lid; plans of two actions.
inline tasks::TaskFile BinTask() {
  return tasks::ParseTaskFile(
      "name: bins\n"
      "picture: {width: 48, height: 32}\n"
      "actions: [open, 'put(cup,left)', 'put(cup,right)']\n"
      "first: open\n"
      "follows:\n"
      "  open: ['put(cup,left)', 'put(cup,right)']\n"
      "plan_length: 2\n"
      "tick_seconds: 0.1\n"
      "action_time_limit: 20\n",
      "bins.yaml");
}

/// A trial of it as a recording of the bus gives one: a frame before anything, then `length` frames
/// an action. Red tells the frame.
inline model::Trial BinTrial(std::uint64_t seed, bool fails, int length = 4) {
  const tasks::TaskFile task = BinTask();
  model::Trial t;
  t.seed = seed;
  t.simulated = false;
  t.task = task.spec.name;
  t.outcome = fails ? "failure" : "success";
  t.reason = fails ? "fell, \"loudly\"" : "";
  t.width = 48;
  t.height = 32;
  t.num_actions = 3;
  t.plan_length = 2;
  t.world_version = "bins-1";
  t.successors = task.spec.successors;
  t.present.assign(3, 1);
  t.segment_succeeded = {1, static_cast<std::int8_t>(fails ? 0 : 1)};
  const int put = 1 + static_cast<int>(seed % 2);
  for (int i = 0; i <= 2 * length; ++i) {
    const int s = i == 0 ? -1 : (i - 1) / length;
    t.actions.push_back(s < 0 ? 3 : s == 0 ? 0 : put);
    t.prev_action.push_back(s <= 0 ? 3 : 0);
    t.segment.push_back(s);
    t.rewards.push_back(i < 2 * length ? 0.0F : fails ? -1.0F : 1.0F);
    t.dones.push_back(i == 2 * length);
    for (int p = 0; p < 48 * 32; ++p) {
      const auto red = static_cast<std::uint8_t>(20 * i + p % 8);
      t.images.insert(t.images.end(), {red, 0, static_cast<std::uint8_t>(p % 48 < 24 ? 200 : 0)});
    }
  }
  return t;
}

/// All that training is told of a trial but its pictures.
inline void ExpectSameLabels(const model::Trial& a, const model::Trial& b) {
  EXPECT_EQ(a.actions, b.actions);
  EXPECT_EQ(a.prev_action, b.prev_action);
  EXPECT_EQ(a.segment, b.segment);
  EXPECT_EQ(a.segment_succeeded, b.segment_succeeded);
  EXPECT_EQ(a.rewards, b.rewards);
  EXPECT_EQ(a.dones, b.dones);
  EXPECT_EQ(a.outcome, b.outcome);
  EXPECT_EQ(a.reason, b.reason);
  EXPECT_EQ(a.plan_length, b.plan_length);
  EXPECT_EQ(a.num_actions, b.num_actions);
  EXPECT_EQ(a.present, b.present);
  EXPECT_EQ(a.successors, b.successors);
  EXPECT_DOUBLE_EQ(a.tick_seconds, b.tick_seconds);
  EXPECT_EQ(a.task, b.task);
}

}  // namespace prospect::tools
