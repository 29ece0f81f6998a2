#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "planner/path.h"
#include "sim/task.h"
#include "sim/task_factory.h"

namespace prospect::tools {

// How often one plan succeeded when it was really carried out.
struct PlanOutcome {
  planner::Path plan;
  int successes = 0;  // of the runs by which plans are judged
  int again = 0;      // of as many other runs: what nobody could know better
};

// Complete legal plans of the scene that `task` shows, in lexicographic order; when there are more
// than `most`, so many of them, drawn by `scene_seed`.
std::vector<planner::Path> LegalPlans(const sim::Task& task, std::uint64_t scene_seed, int most);

// Carries every plan out 2 x `runs` times from the task's present state, which is restored at the
// end. Run i of all plans has the same execution noise, and plans with a common beginning share it.
std::vector<PlanOutcome> CarryOut(sim::Task& task, std::uint64_t scene_seed,
                                  const std::vector<planner::Path>& plans, int runs);

// Outcomes on disk, a line a scene: a stacking scene costs minutes, and its outcomes never change
// for one world. Only ever appended to, a line in one write; damaged lines are skipped. Not thread
// safe; several processes may share the file.
class OutcomeFile {
 public:
  // `path` need not exist, its folder is made. Throws base::DiskError if that cannot be.
  explicit OutcomeFile(const std::string& path);

  const std::vector<PlanOutcome>* Find(std::uint64_t scene_seed) const;  // null: not there
  void Store(std::uint64_t scene_seed, const std::vector<PlanOutcome>& outcomes);

 private:
  std::string path_;
  std::map<std::uint64_t, std::vector<PlanOutcome>> known_;
};

// Where the outcomes of a task's world are kept: a file under $PROSPECT_DATA/plans, or
// ~/.cache/prospect/plans. The name holds all that they depend on but the scene.
std::string OutcomePath(const sim::TaskSpec& spec, const sim::TaskOptions& world, int runs,
                        int most);

}  // namespace prospect::tools
