// Where other workers' rollouts are, as their requests tell between two of their batches. A request
// for a path is a rollout that has come so far; one for a path below it is the same rollout further
// on. A rollout counts on its whole path until its worker's next batch, whose rows then hold it as
// completed or in flight; without that, workers would all go where one of them has just been. Not
// thread safe; refers to a PathTree that must outlive it.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "planner/path_tree.h"

namespace prospect::planner {

class ForeignRollouts {
 public:
  explicit ForeignRollouts(const PathTree* paths) : paths_(paths) {}

  // `writer` asked for `id` at now_us.
  void Hear(std::uint64_t writer, PathId id, std::int64_t now_us);
  // A batch of `writer` came: its rollouts count no more, unless they still wait for an answer.
  // Neither do anybody's that were heard before `oldest_us`.
  void Settle(std::uint64_t writer, std::int64_t oldest_us,
              const std::function<bool(PathId)>& answered);
  // Rollouts that count at `id`.
  std::int64_t At(PathId id) const {
    return id < static_cast<int>(counts_.size()) ? counts_[id] : 0;
  }

 private:
  struct Rollout {
    std::uint64_t writer;
    PathId leaf;
    std::int64_t heard_us;
  };

  void Count(PathId leaf, PathId above, int sign);
  bool IsBelow(PathId id, PathId above) const;

  const PathTree* paths_;
  std::vector<Rollout> rollouts_;
  std::vector<std::int32_t> counts_;  // by path id
};

}  // namespace prospect::planner
