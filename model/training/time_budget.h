#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>

namespace prospect::model {

/// How many iterations each stage of a run gets where a person said how long it may take. A stage's
/// time is a fixed share of it; the iterations that fit are counted by the stage's speed, which is
/// measured once and kept in a file, so that a run that goes on trains what it began. What lies
/// between the stages (reading data, caches, scoring) is not counted. One thread.
class TimeBudget {
 public:
  /// @param path of the file; one of other minutes or another `key` is forgotten
  /// @param minutes above 0, of all stages together
  /// @param shares of the time, by stage; made to add up to 1
  TimeBudget(std::string path, double minutes, std::string key,
             std::map<std::string, double> shares);

  /// Iterations of a stage, at least 1. `seconds` measures those of one iteration; it is asked
  /// where they are not known yet. Throws base::DiskError; std::out_of_range for a stage without a
  /// share.
  std::int64_t Iterations(const std::string& stage, const std::function<double()>& seconds);

 private:
  void Write() const;

  std::string path_;
  double minutes_;
  std::string key_;
  std::map<std::string, double> shares_;
  std::map<std::string, std::int64_t> iterations_;
};

}  // namespace prospect::model
