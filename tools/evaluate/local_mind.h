#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "agent/mind.h"
#include "model/engine.h"
#include "model/novelty.h"
#include "planner/model_source.h"
#include "sim/task.h"

namespace prospect::tools {

/// A mind inside this process. One serves many scenes, one after the other. What it does not know
/// is left out: it knows no calibration (whoever evaluates chooses the threshold), imagines nothing
/// and takes every picture for known, unless a derived mind or Recognise says otherwise. Not thread
/// safe.
class LocalMind : public agent::Mind {
 public:
  /// A new scene, which `task` shows. `task` is only for minds that are allowed to know the world:
  /// those that use the simulator as their model, or only legal moves; its state is as it was after
  /// every call.
  virtual void Enter(sim::Task& task, std::uint64_t scene_seed) = 0;

  /// From now on first pictures are judged by `gauge`; `engine` must outlive the mind.
  void Recognise(model::Engine* engine, const model::NoveltyGauge& gauge);

  agent::MindInfo Choose() override { return {}; }
  std::vector<model::CalibrationSample> Calibrations(bool) override { return {}; }
  agent::SearchAnswer Search(const agent::SearchQuestion& question) final;
  std::map<planner::Path, planner::Evaluation> Judge(const std::vector<planner::Path>&) override {
    return {};
  }
  std::map<planner::Path, agent::Picture> Imagine(const std::vector<planner::Path>&) override {
    return {};
  }
  agent::Recognition Familiar() final;

 protected:
  /// A plan for the question, and what looking for it took.
  virtual agent::SearchAnswer Find(const agent::SearchQuestion& question) = 0;

 private:
  model::Engine* engine_ = nullptr;
  std::optional<model::NoveltyGauge> gauge_;
  std::vector<std::uint8_t> present_;  // picture of the latest search
};

/// Parameters.workers workers on one tree, or one alone.
agent::SearchAnswer SearchWith(const agent::SearchQuestion& question, planner::ModelSource* model);

}  // namespace prospect::tools
