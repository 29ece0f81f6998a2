#include <atomic>
#include <csignal>
#include <cstdio>
#include <string>

#include "base/quiet.h"
#include "cli/options/task.h"
#include "tools/data/commands.h"
#include "tools/recordings/from_robomimic.h"
#include "tools/recordings/from_video.h"

namespace prospect::tools {
namespace {

std::atomic<bool> stop{false};

void HearSignals() {
  std::signal(SIGINT, [](int) { stop = true; });
  std::signal(SIGTERM, [](int) { stop = true; });
}

void Say(const std::string& line) {
  if (!base::Quiet()) std::fprintf(stderr, "%s\n", line.c_str());
}

int Tell(const ConversionReport& report, const std::string& out) {
  if (base::Quiet()) return 0;
  std::printf("%zu trials, %lld frames in %s; %zu repaired, %zu left out\n", report.trials,
              static_cast<long long>(report.frames), out.c_str(), report.repaired, report.left_out);
  return 0;
}

}  // namespace

int RunFromVideo(const cli::DatasetFromVideoOptions& options) {
  HearSignals();
  const FromVideoOptions conversion = {options.folder, options.out, options.every.value_or(0),
                                       options.held_out};
  return Tell(FromVideo(cli::TaskOf(options.task), conversion, Say, &stop), options.out);
}

int RunFromRobomimic(const cli::DatasetFromRobomimicOptions& options) {
  HearSignals();
  const FromRobomimicOptions conversion = {options.file, options.segments, options.camera,
                                           options.out, options.every};
  return Tell(FromRobomimic(cli::TaskOf(options.task), conversion, Say, &stop), options.out);
}

}  // namespace prospect::tools
