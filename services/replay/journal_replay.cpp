#include "services/replay/journal_replay.h"

#include <memory>
#include <optional>
#include <vector>

#include "base/exit_error.h"
#include "lcmtypes/checked_codec.h"
#include "services/binding/evaluation_messages.h"
#include "services/binding/search_table.h"
#include "services/binding/shared_search.h"
#include "services/binding/statistics_messages.h"
#include "services/binding/task_messages.h"
#include "services/from_log/event_log.h"
#include "services/worker/journal.h"

namespace prospect::services {
namespace {

class JournalReader {
 public:
  void Take(const journal_entry_t& entry) {
    if (entry.kind == journal_entry_t::KIND_BEGUN) return Begin(entry);
    if (entry.kind == journal_entry_t::KIND_HEARD) return Hear(entry);
    if (!search_) return;
    if (entry.kind == journal_entry_t::KIND_ADVANCED) Advance(entry);
    if (entry.kind == journal_entry_t::KIND_SENT) Send(entry);
    if (entry.kind == journal_entry_t::KIND_STOPPED) search_->search().Stop();
    if (entry.kind == journal_entry_t::KIND_ABANDONED)
      for (const auto& path : FromMessages(entry.paths)) search_->search().Abandon(path);
  }

  JournalReplay Result() {
    if (search_) result_.table = TableHash(search_->search());
    return result_;
  }

 private:
  template <class T>
  static std::optional<T> MessageOf(const journal_entry_t& entry) {
    if (entry.channel != ChannelOf<T>()) return {};
    const auto result = messages::CheckedDecode<T>(entry.data.data(), entry.data.size());
    return result.ok() ? std::optional<T>(result.value) : std::nullopt;
  }

  void Begin(const journal_entry_t& entry) {
    const auto root = MessageOf<search_root_t>(entry);
    if (!root || !task_) return Differ(entry, "a search without root or task");
    search_ = std::make_unique<SharedSearch>(*root, RulesOfSearch(*task_, *root), entry.writer,
                                             entry.worker_index, entry.steady_us);
    window_ = RequestWindow(entry.writer);
    window_.Begin(*root);
    ++result_.searches;
  }

  void Hear(const journal_entry_t& entry) {
    if (const auto task = MessageOf<task_t>(entry)) task_ = *task;
    if (!search_) return;
    ++result_.heard;
    if (const auto request = MessageOf<expand_request_t>(entry))
      search_->Hear(*request, entry.writer, entry.steady_us);
    if (const auto rows = MessageOf<search_statistics_t>(entry))
      search_->Hear(*rows, entry.steady_us);
    const auto reply = MessageOf<expand_reply_t>(entry);
    if (!reply) return;
    search_->Hear(*reply, &window_);
    window_.Hear(*reply, 0);
  }

  void Advance(const journal_entry_t& entry) {
    const auto asked = search_->search().Advance(entry.amount, entry.steady_us);
    window_.Ask(asked, ServerList(), 0);
    ++result_.advances;
    result_.selections += static_cast<std::int64_t>(asked.size());
    if (asked != FromMessages(entry.paths)) Differ(entry, "other paths were asked for");
  }

  void Send(const journal_entry_t& entry) {
    const auto then = MessageOf<search_statistics_t>(entry);
    auto now = ToMessage(
        search_->search().MakeBatch(static_cast<std::size_t>(entry.amount), entry.steady_us),
        kLeaseMs);
    if (then) now.utime = then->utime;
    ++result_.sent;
    if (!then || messages::CheckedEncode(now) != entry.data) Differ(entry, "other rows were sent");
  }

  void Differ(const journal_entry_t& entry, const std::string& what) {
    if (++result_.differences > 1) return;
    result_.first_difference = "search " + std::to_string(result_.searches) + ", step " +
                               std::to_string(result_.advances) + ", utime " +
                               std::to_string(entry.utime) + ": " + what;
  }

  std::optional<task_t> task_;
  std::unique_ptr<SharedSearch> search_;
  RequestWindow window_{0};  // what was asked for and not heard yet, where workers search apart
  JournalReplay result_;
};

}  // namespace

JournalReplay ReplayJournal(const std::string& path) {
  EventLog log(path);
  JournalReader reader;
  bool any = false;
  for (LogEvent event; log.Next(event);) {
    const auto entry =
        messages::CheckedDecode<journal_entry_t>(event.bytes.data(), event.bytes.size());
    if (event.channel != Journal::kChannel || !entry.ok()) continue;
    any = true;
    reader.Take(entry.value);
  }
  if (!any)
    throw ExitError(kExitDataFile, path + " is no journal: prospect-worker --journal makes one");
  return reader.Result();
}

}  // namespace prospect::services
