#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace prospect::tests {

/// What one process holds, sampled over its life: resident memory and open files, as the system
/// counts them, and what it says it holds itself. One thread.
class Gauge {
 public:
  Gauge(std::string name, int pid) : name_(std::move(name)), pid_(pid) {}

  /// Takes a sample; does nothing for a process that is gone.
  /// @param held entries in caches, by the process's own account
  void Sample(std::int64_t held);

  /// Medians over parts of the samples: from `from` to `to`, shares of their number.
  std::int64_t ResidentKb(double from, double to) const;
  std::int64_t Files(double from, double to) const;
  std::int64_t Held(double from, double to) const;

  const std::string& name() const { return name_; }
  int pid() const { return pid_; }
  std::size_t samples() const { return samples_.size(); }

 private:
  struct Reading {
    std::int64_t resident_kb;
    std::int64_t files;
    std::int64_t held;
  };
  std::int64_t Median(std::int64_t Reading::*what, double from, double to) const;

  std::string name_;
  int pid_;
  std::vector<Reading> samples_;
};

}  // namespace prospect::tests
