#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "services/common/bus.h"
#include "services/common/health.h"
#include "services/common/health_monitor.h"
#include "tasks/task_file.h"

namespace prospect::services {

/// One rule for whoever takes the simulator's place, and whether it was kept.
struct RobotFinding {
  enum class Verdict { kOk, kFault, kNotTried, kNote };
  std::string rule;
  Verdict verdict = Verdict::kOk;
  std::string detail;
};

/// Tries a robot (or the simulator) on the bus: what it says of itself while it holds still, and
/// what it does with commands. It moves: actions are really started. Plays the executive, and holds
/// the robot as one. One thread; the bus must outlive it.
class RobotCheck {
 public:
  /// @param file that TASK is to agree with; null: none
  explicit RobotCheck(Bus& bus, const tasks::TaskFile* file = nullptr);

  /// Runs all checks, in about twenty seconds and the time of a few actions. Throws
  /// kExitServiceLost, and starts nothing, where another executive holds the robot.
  std::vector<RobotFinding> Run();

 private:
  using Condition = std::function<bool()>;

  bool Until(const Condition& condition, double seconds, const Condition& repeat = nullptr);
  void Note(const std::string& rule, bool kept, const std::string& detail = "");
  void NotTried(const std::string& rule, const std::string& why);
  void Tell(const std::string& about, const std::string& words);

  void CheckTask();
  void CheckAgreement();
  void CheckPictures();
  void CheckOutcomes();
  bool CarryOut(int action);
  void CheckStillness();
  void CheckRefusals();
  void CheckAction();
  void CheckHold();
  bool RefusesAnother();
  void CheckCancel();
  void CheckSilence();

  action_command_t Command(std::int8_t kind, int action);
  bool Send(const action_command_t& command);
  bool StartAny();
  bool StartLasting();
  void NewScene();
  void RequireFree();
  bool HeldBy(std::int64_t holder) const { return status_ && status_->holder_id == holder; }
  bool Named(std::int64_t command_id) const;
  bool Running() const;

  Bus& bus_;
  const tasks::TaskFile* file_;
  HealthMonitor monitor_;
  HealthBeacon health_;
  bool silent_ = false;  // plays a dead executive
  std::optional<task_t> task_;
  std::vector<observation_t> pictures_;  // without their pixels
  std::vector<std::uint64_t> looks_;     // hashes of these
  std::vector<double> delays_;           // seconds from a picture's utime until it was heard
  std::vector<std::int64_t> status_ms_;
  std::optional<action_status_t> status_;
  std::map<std::int64_t, std::string> refusals_;  // by executive: the latest reason
  std::int64_t episode_id_ = 0;
  std::int64_t last_id_ = 0, last_scene_ = 0;
  int willing_ = -1;  // an action that was not refused
  std::vector<RobotFinding> findings_;
  std::vector<Subscription> subscriptions_;
};

}  // namespace prospect::services
