// prospect-model-server: holds the networks, encodes pictures and imagines futures for all workers
// on the bus.

#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "base/run_main.h"
#include "services/common/common_options.h"
#include "services/common/health_monitor.h"
#include "services/common/signals.h"
#include "services/model/engine_choice.h"
#include "services/model/engine_loop.h"
#include "services/model/model_server.h"

namespace {

using namespace prospect;
using namespace prospect::services;

struct Options {
  CommonOptions common;
  ModelServerOptions server;
  EngineChoice engine;
  int cache_mb = 64;
  bool check = false;
  double time_batches = 0;  // 0: it is not timed
};

void AddOptions(CLI::App& app, Options& options) {
  cli::DefineProcess(app, options.common);
  AddInstanceFileOption(app, options.common);
  app.add_option("--weights", options.engine.weights,
                 "safetensors file; without networks: scripted[:N], scripted-tree, "
                 "replay:FILE")
      ->envname("PROSPECT_WEIGHTS")
      ->required();
  app.add_option("--task", options.engine.task, "whose table scripted pretends to know: NAME|FILE");
  app.add_option("--threads", options.engine.threads, "threads of the networks")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  app.add_option("--max-batch,--batch", options.server.batch, "most paths a batch")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  app.add_option("--fixed-cost", options.engine.fixed_cost,
                 "A,B: a batch takes A ms + B ms a row, as on a device (for measurements)");
  app.add_option("--memory-mb", options.engine.memory_mb,
                 "answers remembered by content, across searches, MB; 0: none")
      ->check(CLI::Range(0, 65536))
      ->capture_default_str();
  app.add_option("--record-engine", options.engine.record,
                 "write all questions and answers to this file, for --weights replay:FILE");
  app.add_option("--cache-mb", options.cache_mb, "hidden states of one search, MB")
      ->check(CLI::Range(1, 65536))
      ->capture_default_str();
  app.add_flag("--check", options.check, "load the weights, say what they are, and end");
  app.add_option("--time-batches", options.time_batches,
                 "time the engine alone with batches of so many rows on average, print evaluations "
                 "a second, and end")
      ->check(CLI::Range(1.0, 256.0));
  app.add_option("--queue", options.server.queue_paths, "paths that may wait before BUSY")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
}

int Run(int argc, char** argv) {
  CLI::App app("Model server: encodes pictures and imagines futures for all workers on the bus");
  Options options;
  AddOptions(app, options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kExitSuccess : kExitUsage;
  }
  ApplyCommonOptions(options.common, "model");
  options.server.cache_bytes = static_cast<std::size_t>(options.cache_mb) << 20;

  const auto engine = MakeEngine(options.engine);
  if (options.check) {
    const auto& info = engine->info();
    std::printf("%s: %s, %d actions, pictures of %dx%d\n", options.engine.weights.c_str(),
                info.task.c_str(), info.num_actions, info.image_width, info.image_height);
    return kExitSuccess;
  }
  if (options.time_batches > 0) {
    std::printf("%.6g\n", EngineLoopRate(*engine, options.time_batches));
    return kExitSuccess;
  }
  options.server.novelty = LoadNovelty(options.engine);
  Bus bus(options.common.bus);
  HealthMonitor monitor(bus);
  ModelServer server(bus, *engine, options.server);
  monitor.RequireOwnBus();
  if (!options.server.novelty) {
    spdlog::info("{} holds nothing of known pictures: none is refused as unlike them",
                 options.engine.weights);
  }
  while (!StopRequested()) server.Turn();
  server.Leave();
  return kExitSuccess;
}

}  // namespace

int main(int argc, char** argv) {
  return RunMain([&] { return Run(argc, argv); });
}
