#include <atomic>
#include <csignal>
#include <cstdio>
#include <string>

#include "base/quiet.h"
#include "model/jigsaws/gestures.h"
#include "tools/data/commands.h"
#include "tools/jigsaws/converter.h"

namespace prospect::tools {
namespace {

std::atomic<bool> stop{false};

JigsawsOptions ConversionOf(const cli::DatasetJigsawsOptions& options) {
  JigsawsOptions conversion;
  conversion.root = options.root;
  conversion.folder = options.folder;
  conversion.out = options.out;
  conversion.every = options.every;
  conversion.hold_out.trials = options.hold_out;
  conversion.hold_out.names = options.hold_out_trials;
  conversion.hold_out.user = options.hold_out_user.empty() ? '\0' : options.hold_out_user[0];
  conversion.hold_out.valid = options.valid;
  return conversion;
}

}  // namespace

int RunJigsaws(const cli::DatasetJigsawsOptions& options) {
  std::signal(SIGINT, [](int) { stop = true; });
  std::signal(SIGTERM, [](int) { stop = true; });
  const auto say = [](const std::string& line) {
    if (!base::Quiet()) std::fprintf(stderr, "%s\n", line.c_str());
  };
  const JigsawsReport report = ConvertJigsaws(ConversionOf(options), say, &stop);
  if (base::Quiet()) return 0;
  std::printf("%zu trials, %lld frames in %s; %zu repaired, %zu left out\n", report.trials,
              static_cast<long long>(report.frames), options.out.c_str(), report.repaired,
              report.left_out);
  return 0;
}

}  // namespace prospect::tools
