#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "services/console/source.h"
#include "services/from_log/event_log.h"

namespace prospect::services::console {

/// A recording in the place of a bus: the model is fed from it, as fast as it was recorded or 0.1
/// to 10 times so; any moment of it can be gone to, back as well (the model is then made anew from
/// the beginning). All viewers see the same moment. I/O thread only, but for model().
class LogSource : public Source {
 public:
  /// Reads the file once, to know its length and its moments of interest.
  /// @throws ExitError (kExitDataFile) when it is no recording
  LogSource(std::string path, std::size_t memory_bytes, std::function<void()> notify);

  ConsoleModel& model() override { return *model_; }
  nlohmann::json Facts() override;
  void WantPicture(std::int64_t, const planner::Path&, bool) override {}
  /// "play" {playing, speed}, "seek" {at_us, since the beginning}, "step" {by: -1 or 1}.
  std::string Do(const std::string& what, const nlohmann::json& request) override;
  void Tick() override;

 private:
  void Scan();
  void Begin();
  void Seek(std::int64_t at_us);
  void Step(int by);
  bool ReadUntil(std::int64_t utime, std::int64_t deadline_us);

  std::string path_;
  std::size_t memory_bytes_;
  std::function<void()> notify_;
  std::unique_ptr<ConsoleModel> model_;  // guarded by mutex()
  std::unique_ptr<EventLog> log_;
  LogEvent next_;  // read, and not taken yet
  bool more_ = false;
  std::uint64_t generation_ = 0;
  std::int64_t first_us_ = 0, last_us_ = 0, at_us_ = 0, goal_us_ = 0, ticked_us_ = 0;
  std::int64_t damaged_ = 0;
  std::vector<std::int64_t> marks_;  // ascending, since the beginning
  bool playing_ = true;
  double speed_ = 1;
};

}  // namespace prospect::services::console
