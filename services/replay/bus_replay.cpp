#include "services/replay/bus_replay.h"

#include <functional>
#include <map>
#include <optional>

#include "lcmtypes/checked_codec.h"
#include "lcmtypes/validate.h"
#include "services/binding/task_messages.h"
#include "services/common/channels.h"
#include "services/from_log/event_log.h"

namespace prospect::services {
namespace {

// An observer's: no worker has it.
constexpr std::int64_t kObserver = 1;

class BusLogReader {
 public:
  void Take(const LogEvent& event) {
    now_us_ = event.utime;
    Try<task_t>(event, [this](const task_t& task) { task_ = task; });
    Try<search_root_t>(event, [this](const search_root_t& root) { OnRoot(root); });
    Try<expand_reply_t>(event, [this](const expand_reply_t& reply) {
      ReplayedSearch* found = Find(reply.search_id, reply.epoch);
      if (found) found->search->Hear(reply), ++found->replies;
    });
    Try<search_statistics_t>(event, [this](const search_statistics_t& rows) {
      ReplayedSearch* found = Find(rows.search_id, rows.epoch);
      if (found) found->search->Hear(rows, now_us_), ++found->statistics;
    });
  }

  std::vector<ReplayedSearch> searches;

 private:
  template <class T>
  void Try(const LogEvent& event, const std::function<void(const T&)>& take) {
    if (event.channel != ChannelOf<T>()) return;
    const auto result = messages::CheckedDecode<T>(event.bytes.data(), event.bytes.size());
    if (result.ok() && messages::Validate(result.value).empty()) take(result.value);
  }

  ReplayedSearch* Find(std::int64_t search_id, std::int32_t epoch) {
    const auto found = index_.find(search_id);
    if (found == index_.end()) return nullptr;
    ReplayedSearch& search = searches[found->second];
    return search.search->Concerns(search_id, epoch) ? &search : nullptr;
  }

  void OnRoot(const search_root_t& root) {
    if (!task_ || task_->task_hash != root.task_hash) return;
    const auto known = index_.find(root.search_id);
    if (known != index_.end() && searches[known->second].search->root().epoch >= root.epoch) return;
    ReplayedSearch fresh;
    fresh.task = *task_;
    try {
      fresh.search =
          std::make_unique<SharedSearch>(root, RulesOfSearch(*task_, root), kObserver, 0, now_us_);
    } catch (const std::exception&) {
      return;  // the workers refused it, too
    }
    if (known != index_.end()) {
      searches[known->second] = std::move(fresh);
      return;
    }
    index_[root.search_id] = searches.size();
    searches.push_back(std::move(fresh));
  }

  std::optional<task_t> task_;
  std::map<std::int64_t, std::size_t> index_;  // search id -> place in searches
  std::int64_t now_us_ = 0;
};

}  // namespace

std::vector<ReplayedSearch> ReplayBusLog(const std::string& path) {
  EventLog log(path);
  BusLogReader reader;
  for (LogEvent event; log.Next(event);) reader.Take(event);
  return std::move(reader.searches);
}

}  // namespace prospect::services
