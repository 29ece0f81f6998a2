#include "tests/faults/gauge.h"

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

namespace prospect::tests {
namespace {

std::int64_t ReadResidentKb(const std::string& process) {
  std::ifstream file(process + "/statm");
  std::int64_t total = 0;
  std::int64_t resident = 0;
  return file >> total >> resident ? resident * sysconf(_SC_PAGESIZE) / 1024 : 0;
}

std::int64_t CountFiles(const std::string& process) {
  std::error_code gone;
  std::int64_t count = 0;
  for (std::filesystem::directory_iterator file(process + "/fd", gone), end; !gone && file != end;
       file.increment(gone))
    ++count;
  return count;
}

}  // namespace

void Gauge::Sample(std::int64_t held) {
  const std::string process = "/proc/" + std::to_string(pid_);
  const Reading reading{ReadResidentKb(process), CountFiles(process), held};
  if (reading.resident_kb > 0) samples_.push_back(reading);
}

std::int64_t Gauge::Median(std::int64_t Reading::*what, double from, double to) const {
  const auto count = static_cast<double>(samples_.size());
  std::vector<std::int64_t> part;
  for (auto i = static_cast<std::size_t>(from * count); i < static_cast<std::size_t>(to * count);
       ++i)
    part.push_back(samples_[i].*what);
  if (part.empty()) return 0;
  const auto middle = part.begin() + static_cast<std::ptrdiff_t>(part.size() / 2);
  std::nth_element(part.begin(), middle, part.end());
  return *middle;
}

std::int64_t Gauge::ResidentKb(double from, double to) const {
  return Median(&Reading::resident_kb, from, to);
}

std::int64_t Gauge::Files(double from, double to) const {
  return Median(&Reading::files, from, to);
}

std::int64_t Gauge::Held(double from, double to) const { return Median(&Reading::held, from, to); }

}  // namespace prospect::tests
