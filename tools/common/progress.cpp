#include "tools/common/progress.h"

#include <unistd.h>

#include <cstdio>
#include <utility>

#include "base/quiet.h"

namespace prospect::tools {

Progress::Progress(std::string what, int total)
    : what_(std::move(what)),
      total_(total),
      terminal_(isatty(STDERR_FILENO) != 0),
      start_(std::chrono::steady_clock::now()),
      printed_(start_) {}

Progress::~Progress() {
  if (terminal_ && done_ > 0 && !base::Quiet()) std::fputc('\n', stderr);
}

void Progress::Step(const std::string& note) {
  ++done_;
  if (base::Quiet()) return;
  const auto now = std::chrono::steady_clock::now();
  const auto period = terminal_ ? std::chrono::milliseconds(200) : std::chrono::milliseconds(30000);
  if (now - printed_ < period && done_ != total_) return;
  printed_ = now;
  Print(note);
}

void Progress::Print(const std::string& note) {
  constexpr int kBar = 24;
  const double elapsed = std::chrono::duration<double>(printed_ - start_).count();
  const int left = static_cast<int>(elapsed / done_ * (total_ - done_));
  if (terminal_) {
    const auto full = static_cast<std::size_t>(static_cast<long>(kBar) * done_ / total_);
    std::fprintf(stderr, "\r[%s%s] ", std::string(full, '#').c_str(),
                 std::string(kBar - full, '.').c_str());
  }
  std::fprintf(stderr, "%d of %d %s, %d:%02d left%s%s%s", done_, total_, what_.c_str(), left / 60,
               left % 60, note.empty() ? "" : ", ", note.c_str(), terminal_ ? "   " : "\n");
}

}  // namespace prospect::tools
