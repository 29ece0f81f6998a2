#pragma once

#include <functional>
#include <memory>
#include <string>

#include "agent/episode.h"
#include "services/executive/bus_mind.h"
#include "services/executive/bus_world.h"
#include "services/executive/conversation.h"
#include "services/executive/options.h"

namespace prospect::services {

/// An episode against the services on a bus: agent::Episode with world and mind over the bus. PLAN
/// is published when a search ends and after each action, and HEALTH says when it is over. One
/// thread; use once; the conversation must outlive it.
class BusEpisode {
 public:
  /// One line for a person about what has just been done.
  using Tell = std::function<void(const std::string&)>;

  /// Throws std::invalid_argument when options.goal is no goal.
  BusEpisode(Conversation& talk, const ExecutiveOptions& options, Tell tell);

  /// Throws ExitError when services are missing or fall silent, when another executive holds the
  /// robot, when what was asked for cannot be had, or after a stop signal. What else may be thrown,
  /// such as by a message that does not fit the task, is a std::exception; the robot then stands
  /// still.
  agent::EpisodeRecord Run();

  /// After Run() threw: the episode as far as it came, "stopped" for this reason.
  agent::EpisodeRecord Stopped(const std::string& reason);

 private:
  /// Says on bus, log and terminal how the episode goes on.
  class Speaker : public agent::Listener {
   public:
    Speaker(Conversation& talk, BusEpisode::Tell tell) : talk_(talk), tell_(std::move(tell)) {}
    void Tell(const std::string& line) override { tell_(line); }
    void Note(const std::string& line) override;
    void Warn(const std::string& line) override;
    void Searched(const agent::SearchRecord& search, const planner::Plan& plan) override;
    void PlanChanged(const agent::EpisodeRecord& record) override;

   private:
    Conversation& talk_;
    BusEpisode::Tell tell_;
    int searches_ = 0;
  };

  agent::EpisodeRecord Leave(agent::EpisodeRecord record);

  Conversation& talk_;
  ExecutiveOptions options_;
  Speaker speaker_;
  BusWorld world_;
  std::unique_ptr<BusMind> mind_;
  agent::Episode episode_;
};

}  // namespace prospect::services
