#pragma once

#include <map>
#include <vector>

#include "agent/mind.h"
#include "services/executive/conversation.h"
#include "services/executive/familiarity_inbox.h"
#include "services/executive/options.h"
#include "services/executive/predictions.h"
#include "services/executive/search_session.h"

namespace prospect::services {

/// The planner workers and model servers on the bus, as an episode's mind. What ends an episode
/// from outside is an ExitError. One thread; conversation and options must outlive it.
class BusMind : public agent::Mind {
 public:
  BusMind(Conversation& talk, const ExecutiveOptions& options);

  agent::MindInfo Choose() override;
  std::vector<model::CalibrationSample> Calibrations(bool needed) override;
  agent::SearchAnswer Search(const agent::SearchQuestion& question) override;
  std::map<planner::Path, planner::Evaluation> Judge(
      const std::vector<planner::Path>& paths) override;
  std::map<planner::Path, agent::Picture> Imagine(const std::vector<planner::Path>& paths) override;
  agent::Recognition Familiar() override;

 private:
  SearchQuestion ToRoot(const agent::SearchQuestion& question) const;
  search_image_t ImageOf(const agent::Glimpse& glimpse) const;

  Conversation& talk_;
  const ExecutiveOptions& options_;
  SearchSession session_;
  PredictionInbox predictions_;
  FamiliarityInbox familiarity_;
  model_info_t model_{};
};

}  // namespace prospect::services
