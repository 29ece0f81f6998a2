#include "services/predict/command.h"

#include <cstdio>
#include <filesystem>

#include "base/exit_error.h"
#include "base/lock.h"
#include "base/quiet.h"
#include "report/futures_sheet.h"
#include "report/image_edit.h"
#include "report/png.h"
#include "services/common/common_options.h"
#include "services/executive/conversation.h"
#include "services/predict/prediction.h"

namespace prospect::services {
namespace {

namespace fs = std::filesystem;
using namespace report;

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

}  // namespace

int RunPredict(const cli::PredictOptions& options) {
  ApplyCommonOptions(CommonOptions(options.bus), "predict");
  const base::Lock own = base::LockFolder(options.out);
  Bus bus(options.bus.bus);
  Conversation talk(bus, "predict");
  talk.monitor().RequireOwnBus();
  const FuturesSheet sheet = Predict(talk, options);
  Write(sheet, options.out);
  if (!base::Quiet()) Tell(sheet, options.out);
  return kExitSuccess;
}

}  // namespace prospect::services
