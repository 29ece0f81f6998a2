// prospect-video: plays a video in a simulator's place, and draws what comes next in what is shown.

#include "base/run_main.h"
#include "cli/program.h"
#include "services/player/command.h"
#include "services/predict/command.h"

int main(int argc, char** argv) {
  using namespace prospect;
  using cli::Carries;
  const std::vector<cli::Part> parts = {
      Carries("play", "prospect-video play", services::RunPlayVideo),
      Carries("predict", "predict", services::RunPredict),
  };
  return RunMain([&] { return cli::RunPart(argc, argv, parts); });
}
