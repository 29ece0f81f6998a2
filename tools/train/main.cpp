// prospect-train: trains networks, and measures what training made and how fast it is.

#include "cli/program.h"
#include "tools/common/torch_main.h"
#include "tools/train/commands.h"

namespace {

using namespace prospect;

// As it was typed, but of paths only the last part: the rest says nothing elsewhere.
std::string CommandOf(int argc, char** argv) {
  std::string command = "./prospect";
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    command += " " + word.substr(word.find_last_of('/') + 1);
  }
  return command;
}

}  // namespace

int main(int argc, char** argv) {
  using cli::Carries;
  const auto train = [&](const cli::TrainOptions& options) {
    return tools::RunTrain(options, CommandOf(argc, argv));
  };
  const std::vector<cli::Part> parts = {
      Carries<cli::TrainOptions>("train", "train", train),
      Carries("tables", "tables", tools::RunTables),
      Carries("bench", "bench train", tools::RunBenchTrain),
      Carries("bench-engine", "bench engine", tools::RunBenchEngine),
  };
  return tools::RunTorchMain([&] { return cli::RunPart(argc, argv, parts); }, "prospect-train");
}
