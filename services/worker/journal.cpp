#include "services/worker/journal.h"

#include <lcm/eventlog.h>

#include "base/exit_error.h"

namespace prospect::services {

void Journal::Closer::operator()(void* log) const {
  lcm_eventlog_destroy(static_cast<lcm_eventlog_t*>(log));
}

Journal::Journal(const std::string& path, std::int64_t writer, int worker_index)
    : path_(path),
      log_(lcm_eventlog_create(path.c_str(), "w")),
      writer_(writer),
      worker_index_(worker_index) {
  if (!log_) throw ExitError(kExitDisk, "cannot write the journal " + path);
}

Journal::~Journal() = default;

journal_entry_t Journal::Entry(std::int8_t kind, std::int64_t steady_us) const {
  journal_entry_t entry{};
  entry.utime = UtimeNow();
  entry.steady_us = steady_us;
  entry.kind = kind;
  entry.writer = writer_;
  entry.worker_index = worker_index_;
  return entry;
}

void Journal::Write(const journal_entry_t& entry) {
  auto bytes = messages::CheckedEncode(entry);
  std::string channel = kChannel;
  lcm_eventlog_event_t event{};
  event.timestamp = entry.utime;
  event.channellen = static_cast<int>(channel.size());
  event.datalen = static_cast<int>(bytes.size());
  event.channel = channel.data();
  event.data = bytes.data();
  auto* log = static_cast<lcm_eventlog_t*>(log_.get());
  if (lcm_eventlog_write_event(log, &event) != 0)
    throw ExitError(kExitDisk, "cannot write the journal " + path_ + ": is the disk full?");
}

void Journal::Advanced(int wanted, const std::vector<planner::Path>& asked,
                       std::int64_t steady_us) {
  journal_entry_t entry = Entry(journal_entry_t::KIND_ADVANCED, steady_us);
  entry.amount = wanted;
  for (const auto& path : asked) entry.paths.push_back(ToMessage(path));
  entry.num_paths = static_cast<std::int32_t>(entry.paths.size());
  Write(entry);
}

void Journal::Abandoned(const planner::Path& path, std::int64_t steady_us) {
  journal_entry_t entry = Entry(journal_entry_t::KIND_ABANDONED, steady_us);
  entry.paths = {ToMessage(path)};
  entry.num_paths = 1;
  Write(entry);
}

void Journal::Stopped(std::int64_t steady_us) {
  Write(Entry(journal_entry_t::KIND_STOPPED, steady_us));
  Flush();
}

void Journal::Flush() { std::fflush(static_cast<lcm_eventlog_t*>(log_.get())->f); }

}  // namespace prospect::services
