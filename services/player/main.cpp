// prospect-player: a video in a simulator's place on the bus.

#include <CLI/CLI.hpp>

#include "base/run_main.h"
#include "model/dataset.h"
#include "model/jigsaws/gestures.h"
#include "services/common/common_options.h"
#include "services/common/signals.h"
#include "services/player/player.h"

namespace {

using namespace prospect;
using namespace prospect::services;

struct Options {
  CommonOptions common;
  VideoChoice choice;
  double speed = 1;
  bool loop = false;
};

void AddOptions(CLI::App& app, Options& o) {
  std::vector<std::string> tasks;
  for (const std::string& folder : prospect::model::jigsaws::TaskFolders()) {
    tasks.push_back(prospect::model::jigsaws::TaskOfFolder(folder));
  }
  AddCommonOptions(app, o.common);
  AddInstanceFileOption(app, o.common);
  app.add_option("--task", o.choice.task, "whose gestures they are")
      ->check(CLI::IsMember(tasks))
      ->capture_default_str();
  app.add_option("--video", o.choice.video, "video file")->required();
  app.add_option("--transcription", o.choice.transcription,
                 "its gestures, lines 'FIRST LAST Gk' as in JIGSAWS; without: no LABEL");
  app.add_option("--every", o.choice.every,
                 "show one frame in so many, besides the first of each gesture")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  app.add_option("--speed", o.speed, "1: as it was filmed")
      ->check(CLI::Range(0.01, 1000.0))
      ->capture_default_str();
  app.add_flag("--loop", o.loop, "begin again after the end, as the next episode");
}

int Run(int argc, char** argv) {
  CLI::App app("Player: a video's pictures and gestures on the bus, in a simulator's place");
  Options options;
  AddOptions(app, options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kExitSuccess : kExitUsage;
  }
  ApplyCommonOptions(options.common, "simulator");
  Bus bus(options.common.bus);
  try {
    Player player(bus, options.choice, options.speed, options.loop);
    player.monitor().RequireOwnBus();
    while (!StopRequested()) player.Turn();
    player.Leave();
  } catch (const prospect::model::DataError& error) {
    throw ExitError(kExitDataFile, error.what());
  }
  return kExitSuccess;
}

}  // namespace

int main(int argc, char** argv) {
  return RunMain([&] { return Run(argc, argv); });
}
