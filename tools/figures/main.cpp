// prospect-figures: the paper's figures from our own models, on held-out trials. Needs no bus.

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <vector>

#include "base/hash.h"
#include "base/lock.h"
#include "base/quiet.h"
#include "base/run_main.h"
#include "cli/program.h"
#include "model/engine.h"
#include "model/weights_error.h"
#include "tools/figures/drawings.h"

namespace prospect::figures {
namespace {

namespace fs = std::filesystem;
using Options = cli::FiguresOptions;
using report::Page;

// Whether a figure asks V, Q, p or f.
bool Judges(const std::string& name) {
  return name == "futures" || name == "search" || name == "calibration";
}

std::string About(const Options& options, const Studio& studio) {
  return "Task " + options.task + "; weights " + fs::path(studio.weights).filename().string() +
         " (hash " + base::HexText(studio.own.engine->weights_hash()) + "), data set " +
         fs::path(studio.data).filename().string() +
         ", test trials only; `./prospect figures --task " + options.task + " --seed " +
         std::to_string(options.seed) + " --trials " + std::to_string(options.trials) +
         " --samples " + std::to_string(options.samples) + "`.";
}

// In the order in which they are drawn.
std::vector<std::string> Wanted(const Options& options, const Studio& studio) {
  std::vector<std::string> wanted;
  for (const std::string& name : cli::FigureNames()) {
    const bool named =
        std::find(options.only.begin(), options.only.end(), name) != options.only.end();
    if (!named && !options.only.empty()) continue;
    if (studio.own.engine->info().judges || !Judges(name)) {
      wanted.push_back(name);
    } else if (named) {
      throw model::WeightsError(studio.weights + ": " + name + ": " + model::kPicturesOnly);
    }
  }
  return wanted;
}

int Run(const Options& options) {
  const base::Lock own = base::LockFolder(options.out);
  const Studio studio = OpenStudio(options);
  std::vector<Page> pages;
  for (const std::string& name : Wanted(options, studio)) {
    pages.push_back(Draw(name, options, studio));
    WritePage(options.out, pages.back());
    if (base::Quiet()) continue;
    std::printf("%s\n", (fs::path(options.out) / pages.back().file).c_str());
    std::fflush(stdout);
  }
  WriteCaptions(options.out, About(options, studio), pages);
  return 0;
}

}  // namespace
}  // namespace prospect::figures

int main(int argc, char** argv) {
  using namespace prospect;
  const std::vector<cli::Part> parts = {cli::Carries("", "figures", figures::Run)};
  return RunMain([&] { return cli::RunPart(argc, argv, parts); }, "prospect-figures",
                 kExitTaskFailure);
}
