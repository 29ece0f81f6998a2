#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>

#include "cli/report_file.h"
#include "tools/bench/train_bench.h"
#include "tools/train/commands.h"

namespace prospect::tools {
namespace {

using nlohmann::json;

void Print(const json& figures) {
  std::printf("%-17s %5s %-8s %9s %9s %9s %9s %8s %6s %6s %10s %8s\n", "stage", "batch", "of",
              "samples/s", "images/s", "MMA fwd", "MMA bwd", "GFLOP/s", "peak", "cores",
              "iterations", "minutes");
  for (const json& row : figures["rows"]) {
    const auto number = [&row](const char* key) { return row[key].get<double>(); };
    const std::string of = row["sample"].get<std::string>() + "s";
    std::printf("%-17s %5d %-8s %9.1f %9.1f %9.2f %9.2f %8.1f %4.0f %% %6.2f %10.0f %8.1f\n",
                row["stage"].get<std::string>().c_str(), row["batch"].get<int>(), of.c_str(),
                number("samples_per_s"), number("images_per_s"), 1e-6 * number("forward"),
                1e-6 * number("backward"), number("gflops"), 100 * number("peak_share"),
                number("busy_cores"), number("iterations"), number("minutes"));
  }
  std::printf(
      "%s on %s, %s, %d shards on %d threads; large matrix products: %.1f GFLOP/s. MMA: million "
      "multiply-adds a sample.\n",
      figures["task"].get<std::string>().c_str(), figures["device"].get<std::string>().c_str(),
      figures["precision"].get<std::string>().c_str(), figures["shards"].get<int>(),
      figures["threads"].get<int>(), figures["matrix_product_gflops"].get<double>());
}

}  // namespace

int RunBenchTrain(const cli::BenchTrainOptions& options) {
  const json figures = BenchTraining(options);
  if (options.report.talks()) Print(figures);
  cli::WriteReport(options.report, figures);
  return 0;
}

}  // namespace prospect::tools
