#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace prospect::model {

/// A line on stderr, at most one every two seconds: what, how far, how long still. Nothing where
/// the process is quiet (base/quiet.h). Not thread-safe.
class ProgressLine {
 public:
  explicit ProgressLine(std::string what, std::int64_t done_before = 0);
  /// `note` is put behind the numbers, e.g. the loss. Always prints when done == total.
  void Show(std::int64_t done, std::int64_t total, const std::string& note = "");

 private:
  using Clock = std::chrono::steady_clock;
  std::string what_;
  std::int64_t done_before_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_ = start_;
};

}  // namespace prospect::model
