#pragma once

#include <cstdint>
#include <string>

#include "base/hash.h"
#include "model/trial.h"

namespace prospect::model {

/// A small valid trial made by hand: one frame before the first action, then `segments` segments of
/// `length` frames whose action is (seed + segment) % 3, all successful unless `fails`, when the
/// last one fails. Images: a background, and a square whose place tells the segment.
inline Trial MadeTrial(std::uint64_t seed, int segments = 2, bool fails = false, int length = 4,
                       int size = 8, int num_actions = 3) {
  Trial t;
  t.seed = seed;
  t.task = "made";
  t.outcome = fails ? "failure" : "success";
  t.reason = fails ? "time" : "";
  t.width = t.height = size;
  t.num_actions = num_actions;
  t.plan_length = segments;
  t.world_version = "made-1";
  t.task_hash = "00ff";
  t.present.assign(static_cast<std::size_t>(num_actions), 1);
  const auto action_of = [&](int s) {
    return s < 0 ? num_actions : static_cast<int>((seed + static_cast<std::uint64_t>(s)) % 3);
  };
  for (int i = 0; i <= segments * length; ++i) {
    const int s = (i + length - 1) / length - 1;
    t.actions.push_back(action_of(s));
    t.prev_action.push_back(s <= 0 ? num_actions : action_of(s - 1));
    t.segment.push_back(s);
    t.rewards.push_back(i == segments * length ? (fails ? -100.0F : 100.0F) : 0.0F);
    t.dones.push_back(i == segments * length);
    for (int p = 0; p < size * size; ++p) {
      const bool inside = p / size < size / 4 && p % size / (size / 4) == (s + 1) % 4;
      const auto base = static_cast<std::uint8_t>(60 + base::Mix64(seed) % 60);
      for (int c = 0; c < 3; ++c) {
        t.images.push_back(inside && c == action_of(s) % 3 ? std::uint8_t{250} : base);
      }
    }
  }
  t.num_landmarks = 1;  // the square's centre
  for (const int s : t.segment) {
    t.landmarks.push_back((static_cast<float>((s + 1) % 4) + 0.5F) / 4);
    t.landmarks.push_back(0.125F);
  }
  t.segment_succeeded.assign(static_cast<std::size_t>(segments), 1);
  if (fails) t.segment_succeeded.back() = 0;
  return t;
}

}  // namespace prospect::model
