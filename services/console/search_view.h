#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "lcmtypes/messages.h"
#include "planner/plan.h"
#include "services/binding/shared_search.h"
#include "services/console/change_order.h"

namespace prospect::services::console {

/// One search as a page shows it: its whole tree as an observer knows it, which nodes changed
/// since when, and its plan. The page's words for it are in docs/console.md. One thread at a time.
class SearchView {
 public:
  /// @param now_us time of the message, on the clock of Hear()
  /// @throws std::exception where the workers refuse the search, too
  SearchView(const task_t& task, const search_root_t& root, std::int64_t now_us);

  /// Takes what concerns this search. @return whether it did
  bool Hear(const expand_reply_t& reply);
  bool Hear(const search_statistics_t& statistics, std::int64_t now_us);
  void Stop(const std::string& reason);
  /// It takes no more: there is no memory for it.
  void Cut();

  const search_root_t& root() const { return shared_.root(); }
  const task_t& task() const { return task_; }
  bool stopped() const { return stopped_; }
  /// Grows with whatever Meta() tells.
  std::uint64_t revision() const { return revision_; }
  std::int64_t heard_us() const { return heard_us_; }
  void NoteHeard(std::int64_t now_us) { heard_us_ = now_us; }
  /// What it holds, about, bytes.
  std::size_t bytes() const;
  /// Whether a model server would imagine this path; an id of -1 names none.
  bool Legal(const planner::Path& path) const;
  planner::Path PathOf(int node) const { return shared_.search().paths().PathOf(node); }
  int Find(const planner::Path& path) const { return shared_.search().paths().Find(path); }
  int nodes() const { return shared_.search().paths().size(); }
  bool Evaluated(const planner::Path& path) const;

  /// Nodes that changed, as ChangeOrder::After: an array of rows
  /// [id, parent, action, N, W / N, v*, V, f, Q, p, score, mark, server].
  nlohmann::json Rows(std::uint64_t* since, std::size_t most) const;
  std::uint64_t latest_change() const { return changes_.latest(); }

  /// What is told of the search beside its nodes, its plan and its nearest misses included. The
  /// plan is read off at most every 200 ms of `now_us` while the search runs.
  nlohmann::json Meta(std::int64_t now_us);

  /// Q and p of each action that may come after a node.
  nlohmann::json Choices(int node) const;

  /// The latest plan that Meta() read off.
  const planner::Plan& plan() const { return plan_; }

 private:
  struct Shown {
    std::int64_t visits = -1, value_sum = 0;
    float best = 0;
    std::int16_t server = -1;  ///< into servers_
  };

  void Touch(planner::PathId id, int server);
  int ServerIndex(std::int64_t server_id);
  nlohmann::json Row(planner::PathId id) const;
  double ScoreOf(planner::PathId id) const;
  const char* MarkOf(planner::PathId id) const;
  void ReadPlan(std::int64_t now_us);
  nlohmann::json FutureJson(const planner::Future& future) const;

  task_t task_;
  SharedSearch shared_;
  ChangeOrder changes_;
  std::vector<Shown> shown_;  // by path id
  std::vector<std::int64_t> servers_;
  planner::Plan plan_;
  std::uint64_t plan_change_ = 0;
  std::int64_t plan_us_ = 0, begun_us_ = 0, heard_us_ = 0, ended_us_ = 0;
  std::uint64_t revision_ = 1;
  bool stopped_ = false, plan_after_stop_ = false, cut_ = false;
  std::string stop_reason_;
};

/// "3-0-12"; empty for the root: how the page names a path.
std::string PathText(const planner::Path& path);

/// Rounded to four places, so that it is short in JSON; nothing that is not finite.
double Short(double number);

}  // namespace prospect::services::console
