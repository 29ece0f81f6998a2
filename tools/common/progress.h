#pragma once

#include <chrono>
#include <string>

namespace prospect::tools {

// A progress line with the time left, on standard error: rewritten in place on a terminal, every 30
// seconds otherwise.
class Progress {
 public:
  // `what`: the counted things, plural; `total` > 0.
  Progress(std::string what, int total);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // One more is done.
  void Step();

 private:
  void Print();

  std::string what_;
  int total_;
  int done_ = 0;
  bool terminal_;
  std::chrono::steady_clock::time_point start_;
  std::chrono::steady_clock::time_point printed_;
};

}  // namespace prospect::tools
