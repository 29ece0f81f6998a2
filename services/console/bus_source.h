#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <thread>

#include "services/common/bus.h"
#include "services/common/health.h"
#include "services/console/episode_starter.h"
#include "services/console/picture_asker.h"
#include "services/console/source.h"

namespace prospect::services::console {

struct BusSourceOptions {
  std::string bus;            ///< LCM URL
  std::string services_file;  ///< a supervisor's services.json, for names and restarts; empty: none
  std::string out = "out";    ///< where runs leave their results
  bool control = false;       ///< whether the page may press buttons
  std::size_t memory_bytes = ConsoleModel::kUsualBytes;
};

/// A live bus. A thread of its own hears it and says HEALTH; what is published for a viewer
/// (questions to model servers, with control a robot's stop) goes out from the I/O thread at once.
/// With control off nothing but HEALTH and questions for pictures and numbers is ever said.
class BusSource : public Source {
 public:
  /// Opens the bus and begins to hear it. @param notify called on any thread after news
  /// @throws BusError
  BusSource(const BusSourceOptions& options, std::function<void()> notify);
  ~BusSource() override;

  ConsoleModel& model() override { return model_; }
  nlohmann::json Facts() override;
  void WantPicture(std::int64_t search_id, const planner::Path& path, bool urgent) override;
  std::string Do(const std::string& what, const nlohmann::json& request) override;
  void Tick() override;

  /// Whether the bus thread has ended by itself; it has logged why.
  bool failed() const { return failed_; }

 private:
  struct May {
    std::string run, stop, scale;  ///< why not; empty: it may
  };

  void Listen();
  May WhatMay();
  std::string Judge(const nlohmann::json& request);
  std::string Stop();
  void CancelAction();
  void StopExecutiveHere();
  void ReadSupervised();

  BusSourceOptions options_;
  std::function<void()> notify_;
  ConsoleModel model_;  // guarded by mutex()
  Bus bus_;
  HealthBeacon health_;
  std::int64_t client_id_;
  PictureAsker asker_;  // guarded by mutex()
  EpisodeStarter starter_;
  std::int64_t request_id_ = 0;
  std::int64_t stop_until_ms_ = 0;
  std::set<int> signalled_;  // executives that were asked to stop
  nlohmann::json supervised_ = nlohmann::json::array();
  Periodic supervised_due_{1000};
  std::atomic<bool> stopping_{false}, failed_{false};
  Subscription subscription_;
  std::thread thread_;
};

}  // namespace prospect::services::console
