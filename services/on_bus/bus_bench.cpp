#include "services/on_bus/bus_bench.h"

#include <algorithm>

#include "base/hash.h"
#include "services/common/common_options.h"
#include "services/executive/between_trials.h"
#include "services/executive/conversation.h"
#include "services/executive/person.h"
#include "services/executive/preparation.h"

namespace prospect::services {
namespace {

// What decides in a row, as ExecutiveOptions::policy names it; by Rows().
const char* PolicyOf(const std::string& row) {
  if (row == "planner") return "search";
  return row == "random" ? "expert" : "greedy";  // the expert's plan is random, without retries
}

ExecutiveOptions OptionsOf(const cli::EvaluateOnBusOptions& asked) {
  ExecutiveOptions options;
  Take(asked.episode, &options);
  options.out.clear();  // no files of a single episode
  options.reset = asked.reset;
  options.ask = asked.ask;
  options.retries = asked.retries;
  if (asked.surprise) options.surprise = *asked.surprise;
  const bool asks = std::any_of(asked.rows.begin(), asked.rows.end(),
                                [](const std::string& row) { return row != "random"; });
  options.policy = asks ? "search" : "expert";
  return options;
}

constexpr std::int64_t kFittingMs = 3000;  // a server may have to hear TASK first

std::string WeightsFor(Conversation& talk, const ExecutiveOptions& options) {
  const auto fits = [&] {
    try {
      ChooseModel(talk, options);
      return true;
    } catch (const ExitError&) {
      return false;
    }
  };
  talk.Until(fits, kFittingMs);
  return base::HexText(ChooseModel(talk, options).weights_hash);
}

}  // namespace

struct BusBench::Impl {
  bool pause;
  ExecutiveOptions options;  // of the row that needs most
  Bus bus;
  Conversation talk;
  std::string task, weights;
  std::int64_t episodes = 0;
  std::int64_t last = -1;

  explicit Impl(const cli::EvaluateOnBusOptions& asked)
      : pause(asked.pause), options(OptionsOf(asked)), bus(asked.episode.bus.bus), talk(bus) {
    talk.monitor().RequireOwnBus();
    AwaitServices(talk, options);
    task = talk.view().task()->name;
    if (options.AsksNetworks()) weights = WeightsFor(talk, options);
  }
};

const std::vector<std::string>& BusBench::Rows() {
  static const std::vector<std::string> rows = {"planner", "random", "greedy"};
  return rows;
}

BusBench::BusBench(const cli::EvaluateOnBusOptions& options) {
  ApplyCommonOptions(CommonOptions(options.episode.bus), "evaluate");  // key first, then the bus
  impl_ = std::make_unique<Impl>(options);
}
BusBench::~BusBench() = default;

agent::EpisodeRecord BusBench::Run(const std::string& row, std::int64_t seed) {
  Impl& bench = *impl_;
  ++bench.episodes;
  if (bench.pause) {
    AwaitEnter(bench.talk, "Scene " + std::to_string(seed) + ", " + row + ", episode " +
                               std::to_string(bench.episodes));
  }
  if (!bench.options.reset) AwaitNewEpisode(bench.talk, bench.last, bench.options);
  ExecutiveOptions options = bench.options;
  options.seed = seed;
  options.policy = PolicyOf(row);
  if (row != "planner") options.retries = 0;
  agent::EpisodeRecord record = RunSilently(bench.talk, options);
  bench.last = bench.talk.view().episode_id();
  return record;
}

const std::string& BusBench::task() const { return impl_->task; }
const std::string& BusBench::weights() const { return impl_->weights; }

}  // namespace prospect::services
