#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "lcmtypes/checked_codec.h"
#include "lcmtypes/messages.h"
#include "planner/path.h"
#include "services/binding/evaluation_messages.h"
#include "services/common/channels.h"
#include "services/common/clock.h"

namespace prospect::services {

/// Writes what a worker's searches hear and choose, in order, to an LCM log (channel JOURNAL, type
/// journal_entry_t), so that prospect rebuild journal can repeat every step. Written out at each
/// search's end and at the worker's. One thread.
class Journal {
 public:
  static constexpr char kChannel[] = "JOURNAL";

  /// @throws ExitError (kExitDisk) when the file cannot be written
  Journal(const std::string& path, std::int64_t writer, int worker_index);
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  void Begun(const search_root_t& root, std::int64_t steady_us) {
    Write(WithMessage(journal_entry_t::KIND_BEGUN, root, steady_us));
  }
  template <class T>
  void Heard(const T& message, std::int64_t steady_us) {
    Write(WithMessage(journal_entry_t::KIND_HEARD, message, steady_us));
  }
  void Sent(const search_statistics_t& rows, int byte_budget, std::int64_t steady_us) {
    journal_entry_t entry = WithMessage(journal_entry_t::KIND_SENT, rows, steady_us);
    entry.amount = byte_budget;
    Write(entry);
  }
  void Advanced(int wanted, const std::vector<planner::Path>& asked, std::int64_t steady_us);
  void Abandoned(const planner::Path& path, std::int64_t steady_us);
  void Stopped(std::int64_t steady_us);

 private:
  journal_entry_t Entry(std::int8_t kind, std::int64_t steady_us) const;
  void Write(const journal_entry_t& entry);
  void Flush();

  template <class T>
  journal_entry_t WithMessage(std::int8_t kind, const T& message, std::int64_t steady_us) const {
    journal_entry_t entry = Entry(kind, steady_us);
    entry.channel = ChannelOf<T>();
    entry.data = messages::CheckedEncode(message);
    entry.num_bytes = static_cast<std::int32_t>(entry.data.size());
    return entry;
  }

  struct Closer {
    void operator()(void* log) const;
  };
  std::string path_;
  std::unique_ptr<void, Closer> log_;  // LCM's writer, out of sight of those who include this
  std::int64_t writer_;
  int worker_index_;
  std::int64_t events_ = 0;
};

}  // namespace prospect::services
