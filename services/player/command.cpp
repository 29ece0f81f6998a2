#include "services/player/command.h"

#include "base/exit_codes.h"
#include "cli/values.h"
#include "model/dataset.h"
#include "model/jigsaws/gestures.h"
#include "services/common/signals.h"
#include "services/player/player.h"

namespace prospect::services {

void Define(CLI::App& app, PlayVideoOptions& options) {
  std::vector<std::string> tasks;
  for (const std::string& folder : model::jigsaws::TaskFolders()) {
    tasks.push_back(model::jigsaws::TaskOfFolder(folder));
  }
  app.add_option("--task", options.choice.task, "whose gestures they are")
      ->type_name("NAME")
      ->check(cli::OneOf(tasks))
      ->capture_default_str();
  app.add_option("--video", options.choice.video, "video file")->type_name("FILE")->required();
  app.add_option("--transcription", options.choice.transcription,
                 "its gestures, lines 'FIRST LAST Gk' as in JIGSAWS; without: no LABEL")
      ->type_name("FILE");
  app.add_option("--every", options.choice.every,
                 "show one frame in so many, besides the first of each gesture")
      ->type_name("N")
      ->transform(cli::Whole(1, 1000))
      ->capture_default_str();
  app.add_option("--speed", options.speed, "1: as it was filmed")
      ->type_name("X")
      ->check(cli::Real(0.01, 1000))
      ->capture_default_str();
  app.add_flag("--loop", options.loop, "begin again after the end, as the next episode");
  cli::DefineProcess(app, options.bus);
  AddInstanceFileOption(app, options.bus);
}

int RunPlayVideo(const PlayVideoOptions& options) {
  ApplyCommonOptions(options.bus, "simulator");
  Bus bus(options.bus.bus);
  Player player(bus, options.choice, options.speed, options.loop);
  player.monitor().RequireOwnBus();
  while (!StopRequested()) player.Turn();
  player.Leave();
  return kExitSuccess;
}

}  // namespace prospect::services
