#pragma once

#include <memory>
#include <optional>
#include <string>

#include "model/engine.h"
#include "model/fixed_cost_engine.h"
#include "model/novelty.h"

namespace prospect::services {

/// Which engine a model server runs, and what stands around it. From the inside out: the engine,
/// its modelled cost, its memory, its recording.
struct EngineChoice {
  /// A safetensors file, or an engine without networks:
  ///   scripted[:N]    the first N (4) actions of `task`'s table are offered
  ///   scripted-tree   trees whose best plan is known (services/model/scripted_tree_engine.h)
  ///   replay:FILE     a recording that `record` made
  std::string weights;
  std::string task;        ///< NAME|FILE, of "scripted"; empty: the first that has a simulator
  int threads = 2;         ///< of the networks
  std::string fixed_cost;  ///< "A,B": a batch takes A ms + B ms a row; empty: as long as it does
  int memory_mb = 0;       ///< answers remembered across searches, by content; 0: none
  std::string record;      ///< file for all questions and answers; empty: none
};

/// @throws ExitError (kExitUsage, kExitWeights) saying what is wrong with the choice
std::unique_ptr<model::Engine> MakeEngine(const EngineChoice& choice);

/// What these weights hold of known pictures; none where they hold nothing or there are no
/// networks.
/// @throws ExitError (kExitWeights)
std::optional<model::NoveltyGauge> LoadNovelty(const EngineChoice& choice);

/// "A,B" as a cost. @throws ExitError (kExitUsage)
model::BatchCost ParseCost(const std::string& text);

}  // namespace prospect::services
