#pragma once

#include <chrono>

#include "base/seconds_since.h"

namespace prospect::agent {

/// Adds the wall clock's seconds of its life, or until Stop(), to a sum. The sum must outlive it.
class PhaseClock {
 public:
  using Moment = std::chrono::steady_clock::time_point;

  explicit PhaseClock(double* sum) : sum_(sum) {}
  ~PhaseClock() { Stop(); }
  PhaseClock(const PhaseClock&) = delete;
  PhaseClock& operator=(const PhaseClock&) = delete;

  void Stop() {
    if (sum_ != nullptr) *sum_ += base::SecondsSince(since_);
    sum_ = nullptr;
  }

  static Moment Now() { return std::chrono::steady_clock::now(); }

 private:
  double* sum_;
  Moment since_ = Now();
};

}  // namespace prospect::agent
