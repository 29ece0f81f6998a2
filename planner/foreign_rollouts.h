// Where other workers' rollouts are, as their requests tell. A request for a path is a rollout that
// has come so far; one for a path below it is the same rollout further on. Every visit that is so
// heard of is announced to the statistics, once, and counts there until a row of its writer covers
// it: rows of deep paths are sent rarely, and a worker that took such a path for unvisited in the
// meantime would go where others have been (SharedStatistics::Announce).
//
// Not thread safe; refers to a PathTree and a SharedStatistics that must outlive it. Writers that
// the statistics refuse are not followed.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "planner/path_tree.h"
#include "planner/shared_statistics.h"

namespace prospect::planner {

class ForeignRollouts {
 public:
  ForeignRollouts(const PathTree* paths, SharedStatistics* statistics)
      : paths_(paths), statistics_(statistics) {}

  // `writer` asked for `id` at now_us. `answered`: its evaluation is known here already. A request
  // heard again changes nothing. Of two that wait for one path, the one with the higher id gives
  // its rollout up, as Search does.
  void Hear(std::uint64_t writer, PathId id, bool answered, std::int64_t now_us);
  // The rollout of `writer` that waits at `id`, if there is one, is given up: it counts no more.
  void GiveUp(std::uint64_t writer, PathId id);
  // The evaluation of `id` came. Returns the writer whose rollout waited for it, or 0.
  std::uint64_t Answer(PathId id);
  // Rollouts last heard of before `oldest_us` are followed no further; those that were never
  // answered count no more.
  void Forget(std::int64_t oldest_us);

 private:
  struct Rollout {
    PathId leaf;
    bool answered;
    std::int64_t heard_us;
  };
  using Rollouts = std::vector<Rollout>;

  bool Follow(Rollouts* rollouts, std::uint64_t writer, const Rollout& now);
  void WaitAt(std::uint64_t writer, PathId id);
  bool IsBelow(PathId id, PathId above) const;

  const PathTree* paths_;
  SharedStatistics* statistics_;
  std::unordered_map<std::uint64_t, Rollouts> rollouts_;  // by writer
  std::unordered_map<PathId, std::uint64_t> waiting_;     // unanswered path -> the writer there
  std::int64_t forgot_us_ = 0;                            // Forget's last `oldest_us`
};

}  // namespace prospect::planner
