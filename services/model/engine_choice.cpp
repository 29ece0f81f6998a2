#include "services/model/engine_choice.h"

#include <stdexcept>
#include <utility>

#include "base/exit_error.h"
#include "cli/options/task.h"
#include "model/caching_engine.h"
#include "model/recorded_engine.h"
#include "model/scripted_engine.h"
#include "services/model/scripted_tree_engine.h"

namespace prospect::services {
namespace {

using EnginePtr = std::unique_ptr<model::Engine>;

struct Named {
  std::string name, argument;  // "name:argument"
};

Named Split(const std::string& text) {
  const auto colon = text.find(':');
  if (colon == std::string::npos) return {text, ""};
  return {text.substr(0, colon), text.substr(colon + 1)};
}

// "scripted" offers the first four actions of the table; "scripted:N" the first N.
EnginePtr MakeScripted(const Named& named, const std::string& wish) {
  const std::string usual = cli::TaskNames(cli::Tasks::kSimulated).front();
  const sim::TaskSpec& task = cli::TaskOf(wish.empty() ? usual : wish).spec;
  model::ScriptedOptions options;
  options.task = task.name;
  options.num_actions = static_cast<int>(task.actions.size());
  options.image_width = task.image_width;
  options.image_height = task.image_height;
  try {
    if (!named.argument.empty()) options.offered_actions = std::stoi(named.argument);
  } catch (const std::exception&) {
    throw ExitError(kExitUsage, "--weights scripted:" + named.argument +
                                    ": say scripted, or scripted:N with N actions offered");
  }
  return std::make_unique<model::ScriptedEngine>(options);
}

EnginePtr Load(const EngineChoice& choice) {
  const Named named = Split(choice.weights);
  if (named.name == "scripted") return MakeScripted(named, choice.task);
  if (named.name == ScriptedTreeEngine::kTask) return std::make_unique<ScriptedTreeEngine>();
  try {
    if (named.name == "replay") return std::make_unique<model::ReplayEngine>(named.argument);
    return model::LoadDecidingEngine(choice.weights, choice.threads);
  } catch (const std::exception& error) {
    throw ExitError(kExitWeights, error.what());
  }
}

EnginePtr Recorded(EnginePtr engine, const std::string& file) {
  try {
    return std::make_unique<model::RecordingEngine>(std::move(engine), file);
  } catch (const std::runtime_error& error) {
    throw ExitError(kExitDisk, error.what());
  }
}

bool HoldsNetworks(const Named& named) {
  return named.name != "scripted" && named.name != ScriptedTreeEngine::kTask &&
         named.name != "replay";
}

}  // namespace

model::BatchCost ParseCost(const std::string& text) {
  const auto comma = text.find(',');
  try {
    model::BatchCost cost;
    cost.fixed_ms = std::stod(text.substr(0, comma));
    cost.row_ms = std::stod(text.substr(comma + 1));
    if (comma != std::string::npos && cost.fixed_ms >= 0 && cost.row_ms >= 0) return cost;
  } catch (const std::exception&) {
    // Told below, like a number out of range.
  }
  throw ExitError(kExitUsage, "--fixed-cost " + text + ": say A,B for A ms a batch + B ms a row");
}

std::optional<model::NoveltyGauge> LoadNovelty(const EngineChoice& choice) {
  try {
    if (HoldsNetworks(Split(choice.weights))) return model::NoveltyGauge::Load(choice.weights);
    return std::nullopt;
  } catch (const std::exception& error) {
    throw ExitError(kExitWeights, error.what());
  }
}

std::unique_ptr<model::Engine> MakeEngine(const EngineChoice& choice) {
  EnginePtr engine = Load(choice);
  if (!choice.fixed_cost.empty()) {
    engine =
        std::make_unique<model::FixedCostEngine>(std::move(engine), ParseCost(choice.fixed_cost));
  }
  if (choice.memory_mb > 0) {
    engine = std::make_unique<model::CachingEngine>(
        std::move(engine), static_cast<std::size_t>(choice.memory_mb) << 20);
  }
  if (!choice.record.empty()) engine = Recorded(std::move(engine), choice.record);
  return engine;
}

}  // namespace prospect::services
