// Processor time of the calling thread: what a piece of code costs, on a machine that does other
// things besides. A standard clock for std::chrono.
#pragma once

#include <ctime>

#include <chrono>

namespace prospect::tools {

struct CpuClock {
  using duration = std::chrono::nanoseconds;
  using rep = duration::rep;
  using period = duration::period;
  using time_point = std::chrono::time_point<CpuClock>;
  static constexpr bool is_steady = true;
  static time_point now() {
    timespec time;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return time_point(std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec));
  }
};

}  // namespace prospect::tools
