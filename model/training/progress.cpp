#include "model/training/progress.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "base/quiet.h"

namespace prospect::model {

ProgressLine::ProgressLine(std::string what, std::int64_t done_before)
    : what_(std::move(what)), done_before_(done_before) {}

void ProgressLine::Show(std::int64_t done, std::int64_t total, const std::string& note) {
  if (base::Quiet()) return;
  const Clock::time_point now = Clock::now();
  if (done < total && now - last_ < std::chrono::seconds(2)) return;
  last_ = now;
  const double seconds = std::chrono::duration<double>(now - start_).count();
  const auto fresh = static_cast<double>(std::max<std::int64_t>(1, done - done_before_));
  const double left = seconds / fresh * static_cast<double>(total - done);
  std::fprintf(stderr, "%-18s %8lld/%lld  %5.0f s gone, %5.0f s left  %s\n", what_.c_str(),
               static_cast<long long>(done), static_cast<long long>(total), seconds, left,
               note.c_str());
}

}  // namespace prospect::model
