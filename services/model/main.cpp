// prospect-model-server: holds the networks, encodes pictures and imagines futures for all workers
// on the bus.

#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "model/engine.h"
#include "model/scripted_engine.h"
#include "services/common/common_options.h"
#include "services/common/health_monitor.h"
#include "services/common/run_main.h"
#include "services/common/signals.h"
#include "services/model/model_server.h"

namespace {

using namespace prospect::services;

constexpr char kScripted[] = "scripted";

struct Options {
  CommonOptions common;
  ModelServerOptions server;
  std::string weights;
  int threads = 2;
  int cache_mb = 64;
};

void AddOptions(CLI::App& app, Options& options) {
  AddCommonOptions(app, options.common);
  app.add_option("--weights", options.weights,
                 "safetensors file, or 'scripted' for the networkless engine of tests")
      ->envname("PROSPECT_WEIGHTS")
      ->required();
  app.add_option("--threads", options.threads, "threads of the networks")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  app.add_option("--batch", options.server.batch, "most paths a batch")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  app.add_option("--cache-mb", options.cache_mb, "hidden states of one search, MB")
      ->check(CLI::Range(1, 65536))
      ->capture_default_str();
  app.add_option("--queue", options.server.queue_paths, "paths that may wait before BUSY")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
}

// "scripted" offers the first four actions of the table; "scripted:N" the first N.
std::unique_ptr<prospect::model::Engine> MakeScripted(const std::string& weights) {
  prospect::model::ScriptedOptions options;
  if (weights != kScripted) {
    try {
      options.offered_actions = std::stoi(weights.substr(sizeof kScripted));
    } catch (const std::exception&) {
      throw ExitError(kExitUsage, "--weights " + weights +
                                      ": say scripted, or scripted:N with N actions offered");
    }
  }
  return std::make_unique<prospect::model::ScriptedEngine>(options);
}

std::unique_ptr<prospect::model::Engine> LoadEngine(const Options& options) {
  if (options.weights.rfind(kScripted, 0) == 0) return MakeScripted(options.weights);
  try {
    return prospect::model::LoadTorchEngine(options.weights, options.threads);
  } catch (const std::exception& error) {
    throw ExitError(kExitWeights, error.what());
  }
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

  const auto engine = LoadEngine(options);
  Bus bus(options.common.bus);
  HealthMonitor monitor(bus);
  ModelServer server(bus, *engine, options.server);
  monitor.RequireOwnBus();
  while (!StopRequested()) server.Turn();
  server.Leave();
  return kExitSuccess;
}

}  // namespace

int main(int argc, char** argv) {
  return RunMain([&] { return Run(argc, argv); });
}
