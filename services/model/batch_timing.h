#pragma once

#include <cstdint>
#include <map>
#include <vector>

namespace prospect::services {

/// When to begin a batch. A batch begins as soon as there is work, but for one case: clients that
/// were just answered are due back with their next question, and to begin without them costs the
/// fixed part of a batch once more (with blocking clients, half of them would compute while the
/// other half waits, for ever). So the server waits for them, at most as long as
///   - one measured round trip: an answer's sending to its client's next request, and
///   - the fixed part of a batch, which is all that can be won: the intercept a of the line
///     a + b x rows through recent batches' times.
/// A client that does not come back in time is not waited for again until it has come in time once
/// more by itself. Time is an argument, microseconds of any steady clock. One thread.
class BatchTiming {
 public:
  /// These clients were just answered.
  void NoteAnswered(const std::vector<std::int64_t>& clients, std::int64_t now_us);

  /// A request of this client arrived.
  void NoteRequest(std::int64_t client, std::int64_t now_us);

  /// A batch of `rows` took `batch_us`.
  void NoteBatch(int rows, double batch_us);

  /// Microseconds that a batch should still wait for clients due back; 0: begin now.
  std::int64_t WaitUs(std::int64_t now_us);

  /// The fixed part of a batch and a row's part, as measured so far, microseconds.
  double fixed_us() const { return fixed_us_; }
  double row_us() const { return row_us_; }

 private:
  struct Client {
    std::int64_t answered_us = 0;
    double round_trip_us = 0;  // smoothed; 0: not known yet
    bool due = false;          // answered, and awaited
    bool prompt = true;        // came back in time when last awaited
  };

  std::int64_t LongestUs(const Client& client) const;
  void DropOldClients(std::int64_t now_us);

  std::map<std::int64_t, Client> clients_;
  // Sums over recent batches, fading: of 1, rows, rows^2, time, rows x time.
  double n_ = 0, x_ = 0, xx_ = 0, y_ = 0, xy_ = 0;
  double fixed_us_ = 0, row_us_ = 0;
};

}  // namespace prospect::services
