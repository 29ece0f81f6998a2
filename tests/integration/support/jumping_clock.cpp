// Loaded before a program (LD_PRELOAD), makes its wall clock jump: every 700 ms it is right, five
// hours behind, or seven hours ahead. The steady clock is left alone, as a person who sets a
// machine's time leaves it.

#include <sys/syscall.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

namespace {

constexpr long kPeriodMs = 700;
constexpr long kHour = 3600;

long OffsetSeconds() {
  timespec steady{};
  syscall(SYS_clock_gettime, CLOCK_MONOTONIC, &steady);
  const long period = (steady.tv_sec * 1000 + steady.tv_nsec / 1000000) / kPeriodMs;
  const long offsets[] = {0, -5 * kHour, 7 * kHour};
  return offsets[period % 3];
}

bool IsWallClock(clockid_t clock) {
  return clock == CLOCK_REALTIME || clock == CLOCK_REALTIME_COARSE;
}

}  // namespace

extern "C" int clock_gettime(clockid_t clock, timespec* time) noexcept {
  const long status = syscall(SYS_clock_gettime, clock, time);
  if (status == 0 && IsWallClock(clock)) time->tv_sec += OffsetSeconds();
  return static_cast<int>(status);
}

extern "C" int gettimeofday(timeval* __restrict time, void* __restrict) noexcept {
  timespec wall{};
  clock_gettime(CLOCK_REALTIME, &wall);
  time->tv_sec = wall.tv_sec;
  time->tv_usec = wall.tv_nsec / 1000;
  return 0;
}

extern "C" time_t time(time_t* out) noexcept {
  timespec wall{};
  clock_gettime(CLOCK_REALTIME, &wall);
  if (out) *out = wall.tv_sec;
  return wall.tv_sec;
}
