// prospect-predict: asks the model server what the scene on the bus will look like next, and writes
// the pictures. Nothing is planned and nothing is carried out.

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <limits>

#include "base/lock.h"
#include "base/run_main.h"
#include "report/futures_sheet.h"
#include "report/image_edit.h"
#include "report/png.h"
#include "services/common/common_options.h"
#include "services/executive/conversation.h"
#include "services/predict/prediction.h"

namespace {

using namespace prospect;
using namespace prospect::report;
using namespace prospect::services;
namespace fs = std::filesystem;

struct Options {
  CommonOptions common;
  PredictOptions predict;
  std::string out;
};

void AddOptions(CLI::App& app, Options& o) {
  AddCommonOptions(app, o.common);
  app.add_option("--out", o.out, "folder for futures.png, seen.png and a picture a future")
      ->required();
  app.add_option("--actions", o.predict.actions,
                 "what is done from now on, by names in TASK, such as G3,G6; without: the action "
                 "under way, and after it each that may follow");
  app.add_option("--truth", o.predict.truth_seconds,
                 "wait so many seconds for what really comes, and show it beside; 0: do not")
      ->check(CLI::Range(0.0, 3600.0))
      ->capture_default_str();
  app.add_option("--seed", o.predict.seed,
                 "wait for the simulated scene of this seed; -1: whichever is there")
      ->check(CLI::Range(std::int64_t{-1}, std::numeric_limits<std::int64_t>::max()))
      ->capture_default_str();
  app.add_flag("--from-start", o.predict.from_start, "wait until the next action begins");
  app.add_option("--segment", o.predict.segment,
                 "wait until this action of the episode begins, 0 the first")
      ->check(CLI::Range(0, 100000))
      ->capture_default_str();
  app.add_option("--services-timeout-ms", o.predict.services_timeout_ms,
                 "how long to wait for services")
      ->check(CLI::Range(0, 3600000))
      ->capture_default_str();
  app.add_option("--picture-timeout-ms", o.predict.picture_timeout_ms,
                 "how long to wait for a picture, and for an action to begin")
      ->check(CLI::Range(0, 3600000))
      ->capture_default_str();
}

std::string FileOf(std::size_t number) {
  char text[32];
  std::snprintf(text, sizeof text, "future-%02zu.png", number + 1);
  return text;
}

void Tell(const FuturesSheet& sheet, const std::string& out) {
  for (std::size_t i = 0; i < sheet.futures.size(); ++i) {
    const ImaginedFuture& future = sheet.futures[i];
    std::printf("%s  %s", FileOf(i).c_str(), future.words.c_str());
    if (!future.truth.empty()) {
      std::printf("  MAE %.4f, what was seen %.4f",
                  MeanAbsoluteError(future.imagined, future.truth),
                  MeanAbsoluteError(sheet.seen, future.truth));
    }
    std::printf("\n");
  }
  std::printf("%s\n", (fs::path(out) / "futures.png").c_str());
}

void Write(const FuturesSheet& sheet, const std::string& out) {
  try {
    WritePng(out + "/seen.png", sheet.seen);
    for (std::size_t i = 0; i < sheet.futures.size(); ++i) {
      WritePng(out + "/" + FileOf(i), sheet.futures[i].imagined);
    }
    WriteFuturesSheet(sheet, out + "/futures.png");
  } catch (const std::exception& error) {
    throw ExitError(kExitDisk, error.what());
  }
}

int Run(int argc, char** argv) {
  CLI::App app("Predict: what the scene on the bus will look like after the next actions");
  Options options;
  AddOptions(app, options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kExitSuccess : kExitUsage;
  }
  ApplyCommonOptions(options.common, "predict");
  const prospect::base::Lock own = prospect::base::LockFolder(options.out);
  Bus bus(options.common.bus);
  Conversation talk(bus, "predict");
  talk.monitor().RequireOwnBus();
  const FuturesSheet sheet = Predict(talk, options.predict);
  Write(sheet, options.out);
  Tell(sheet, options.out);
  return kExitSuccess;
}

}  // namespace

int main(int argc, char** argv) {
  return RunMain([&] { return Run(argc, argv); });
}
