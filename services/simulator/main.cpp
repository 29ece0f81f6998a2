// prospect-simulator: a simulated robot in its world, on the bus.

#include <CLI/CLI.hpp>
#include <cstdio>

#include "base/run_main.h"
#include "services/common/common_options.h"
#include "services/common/signals.h"
#include "services/simulator/simulator.h"
#include "sim/task_factory.h"

namespace {

using namespace prospect;
using namespace prospect::services;

// How pictures are to differ from those of trials (sim/shift.h).
struct ShiftChoice {
  std::string factor;
  int strength = 0;  // 0: not at all
};

void AddShiftOptions(CLI::App& app, ShiftChoice& shift) {
  CLI::Option* factor =
      app.add_option("--factor", shift.factor,
                     "shift what the camera shows away from what trials show; see --strength")
          ->check(CLI::IsMember(prospect::sim::ShiftFactors()));
  CLI::Option* strength = app.add_option("--strength", shift.strength, "how far, 1 to 5")
                              ->check(CLI::Range(1, prospect::sim::kShiftStrengths));
  factor->needs(strength);
  strength->needs(factor);
}

void AddOptions(CLI::App& app, SimulatorOptions& options) {
  app.add_option("--task", options.task, "world to simulate")
      ->envname("PROSPECT_TASK")
      ->capture_default_str();
  app.add_option("--seed", options.seed, "first scene")->capture_default_str();
  app.add_option("--objects", options.scene.objects, "navigation: objects on the site")
      ->check(CLI::Range(4, 7))
      ->capture_default_str();
  app.add_option("--legs", options.scene.legs, "navigation: actions in a complete plan")
      ->check(CLI::Range(3, 5))
      ->capture_default_str();
  app.add_option("--tower", options.scene.tower, "stacking: blocks in the tower")
      ->check(CLI::Range(2, 4))
      ->capture_default_str();
  app.add_option("--scene-file", options.scene.scene_file,
                 "stacking: a file like config/scenes/stacking.yaml")
      ->check(CLI::ExistingFile);
  app.add_option("--image-noise", options.scene.image_noise, "sensor noise, share of full range")
      ->check(CLI::Range(0.0, 0.25))
      ->capture_default_str();
  app.add_flag("--real-time", options.real_time, "let the clock run as a robot's would");
  app.add_option("--frames-per-second", options.frames_per_second,
                 "pace of the clock otherwise, frames a second of wall clock")
      ->check(CLI::Range(0.1, 10000.0))
      ->capture_default_str();
}

// For whoever starts a deployment: what is wrong with the options is told before anything runs.
int Check(const SimulatorOptions& options) {
  const auto task = prospect::sim::MakeTask(options.task, options.scene);
  std::printf("%s\n", task->spec().world_version.c_str());
  return kExitSuccess;
}

int Run(int argc, char** argv) {
  CLI::App app(
      "Simulator: a robot in its world; publishes what its camera sees and carries actions out");
  CommonOptions common;
  SimulatorOptions options;
  cli::DefineProcess(app, common);
  AddInstanceFileOption(app, common);
  AddOptions(app, options);
  ShiftChoice shift;
  AddShiftOptions(app, shift);
  bool check = false;
  app.add_flag("--check", check, "make the scene, say which world it is, and end");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kExitSuccess : kExitUsage;
  }
  ApplyCommonOptions(common, "simulator");
  if (shift.strength > 0) prospect::sim::SetShift(shift.factor, shift.strength, &options.scene);

  try {
    if (check) return Check(options);
    Bus bus(common.bus);
    Simulator simulator(bus, options);
    simulator.monitor().RequireOwnBus();
    while (!StopRequested()) simulator.Turn();
    simulator.Leave();
  } catch (const std::invalid_argument& error) {
    throw ExitError(kExitUsage, error.what());
  }
  return kExitSuccess;
}

}  // namespace

int main(int argc, char** argv) {
  return RunMain([&] { return Run(argc, argv); });
}
