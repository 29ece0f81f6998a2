#pragma once

#include <chrono>
#include <string>

namespace prospect::tools {

// A progress bar with the time left, on standard error: rewritten in place on a terminal; otherwise
// a line without the bar every 30 seconds. Nothing where the process is quiet (base/quiet.h).
class Progress {
 public:
  // `what`: the counted things, plural; `total` > 0.
  Progress(std::string what, int total);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // One more is done. `note` is shown at the end of the line.
  void Step(const std::string& note = "");

 private:
  void Print(const std::string& note);

  std::string what_;
  int total_;
  int done_ = 0;
  bool terminal_;
  std::chrono::steady_clock::time_point start_;
  std::chrono::steady_clock::time_point printed_;
};

}  // namespace prospect::tools
