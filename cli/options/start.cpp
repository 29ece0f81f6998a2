#include "cli/options/start.h"

#include "cli/values.h"

namespace prospect::cli {
namespace {

constexpr char kStartGroup[] = "The deployment";

}  // namespace

void DefineWeights(CLI::App& app, std::string& weights) {
  app.add_option("--weights", weights, "weights file, its folder, or 'scripted'")
      ->type_name("PATH")
      ->default_str("the bundled ones")
      ->group(kStartGroup);
}

void DefineStart(CLI::App& app, StartOptions& options) {
  DefineWeights(app, options.weights);
  app.add_option("--factor", options.factor, "shift what the camera shows")
      ->type_name("NAME")
      ->check(OneOf({"light", "camera", "colour", "noise"}))
      ->group(kStartGroup);
  app.add_option("--strength", options.strength, "how far")
      ->type_name("N")
      ->transform(Whole(1, 5))
      ->group(kStartGroup);
  app.add_flag("--open", options.open,
               "no key, so that whoever can send on the bus can move the robot")
      ->group(kStartGroup);
}

std::string StartDefect(const StartOptions& options, const std::string& task) {
  if (options.factor.empty() && options.strength == 0) return "";
  if (options.factor.empty() || options.strength == 0)
    return "--factor light, camera, colour or noise goes with --strength 1 to 5";
  if (task == "stacking" || task == "navigation") return "";
  return "--factor is for stacking and navigation";
}

}  // namespace prospect::cli
