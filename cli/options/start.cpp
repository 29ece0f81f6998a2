#include "cli/options/start.h"

#include "cli/options/task.h"
#include "cli/options/weights.h"

namespace prospect::cli {
namespace {

constexpr char kStartGroup[] = "The deployment";

}  // namespace

void DefineWeights(CLI::App& app, std::string& weights) {
  DefineWeightsFile(app, weights);
  app.get_option("--weights")->group(kStartGroup);
}

void DefineStart(CLI::App& app, StartOptions& options) {
  DefineWeights(app, options.weights);
  DefineShift(app, options.shift);
  for (const char* name : {"--factor", "--strength"}) app.get_option(name)->group(kStartGroup);
  app.add_flag("--open", options.open,
               "no key, so that whoever can send on the bus can move the robot")
      ->group(kStartGroup);
}

std::string StartDefect(const StartOptions& options, const std::string& task) {
  const auto& simulator = TaskOf(task).simulator;
  if (options.shift.factor.empty() || (simulator && simulator->shifts)) return "";
  return "--factor is not for " + TaskOf(task).spec.name;
}

}  // namespace prospect::cli
