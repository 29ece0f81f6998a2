#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "agent/mind.h"
#include "lcmtypes/messages.h"
#include "services/binding/request_window.h"
#include "services/binding/shared_search.h"
#include "services/executive/conversation.h"

namespace prospect::services {

/// What is to be searched: the root without ids, and the pictures it starts from.
struct SearchQuestion {
  search_root_t root{};      ///< all fields but utime, executive_id, search_id and budget_ms
  search_image_t first{};    ///< the episode's first picture: image_id set
  search_image_t present{};  ///< the present picture; the same image_id as `first` at the start
  std::int64_t budget_ms = -1;
  std::int64_t samples =
      1;  ///< rollouts of all workers together; root.samples is what each worker stops at
};

/// What a search came to; its table compares with what prospect rebuild bus says.
struct SearchAnswer : agent::SearchAnswer {
  double searching_seconds = 0;  ///< from the first evaluation heard to the budget's end
};

/// Runs searches over the bus: announces the root, hands out the pictures, listens to rows and
/// evaluations, ends the search and reads off the plan. It makes no rollout itself. The answer is
/// what any other listener reads off, too. One search at a time; one thread; the conversation must
/// outlive it.
class SearchSession {
 public:
  explicit SearchSession(Conversation& talk);

  /// Throws kExitServiceLost when all servers or all workers are silent for 3 s or nothing moves
  /// for 10 s, kExitInterrupted after a stop signal; SEARCH_STOP says so on the bus first.
  SearchAnswer Search(const SearchQuestion& question);

  /// What the model servers say of these paths, which the rules must allow, from the root of the
  /// latest search on (EXPAND_REQUEST, repeated until answered). Throws kExitServiceLost when some
  /// do not come within 10 s.
  std::map<planner::Path, planner::Evaluation> Evaluate(const std::vector<planner::Path>& paths);

  /// The latest search as it was heard; there must have been one.
  const planner::Search& search() const { return shared_->search(); }

  /// The root of the latest search: for PREDICT_REQUESTs.
  const search_root_t& root() const { return root_; }

 private:
  void Begin(const SearchQuestion& question);
  void Announce();
  void HandOutPictures();
  bool Over();
  void RequireLife();
  void Stop(const std::string& reason);
  void CloseRound(const std::string& reason);
  void FetchMissing();
  std::vector<planner::Path> Unknown(const std::vector<planner::Path>& paths) const;
  bool AllFinal() const;
  bool ServersReady() const;
  SearchAnswer Collect(std::int64_t started_ms) const;

  Conversation& talk_;
  RequestWindow window_;
  SearchQuestion question_;
  search_root_t root_{};
  std::unique_ptr<SharedSearch> shared_;
  std::string ended_by_;
  std::int64_t started_ms_ = 0;
  std::int64_t first_answer_us_ = 0, over_us_ = 0;  // 0: not yet
  std::int64_t servers_heard_ms_ = 0;
  std::int64_t workers_heard_ms_ = 0;
  std::int64_t progress_ms_ = 0;
  std::int64_t progress_ = 0;
  std::vector<Subscription> subscriptions_;
};

}  // namespace prospect::services
