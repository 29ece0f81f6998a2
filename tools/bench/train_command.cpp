// prospect-train-bench: how fast training's stages run here, against the machine's matrix products.

#include <CLI/CLI.hpp>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>

#include "base/json_file.h"
#include "tools/bench/train_bench.h"
#include "tools/common/program.h"

namespace {

using nlohmann::json;
using prospect::tools::TrainBenchOptions;

void AddOptions(CLI::App* app, TrainBenchOptions* options, std::string* json_file) {
  app->add_option("--task", options->task, "The task whose networks are trained")->required();
  app->add_option("--device", options->device, "cpu or cuda")
      ->check(CLI::IsMember({"cpu", "cuda"}))
      ->capture_default_str();
  app->add_option("--precision", options->precision, "float32, or mixed: as train's")
      ->check(CLI::IsMember({"float32", "mixed"}))
      ->capture_default_str();
  app->add_option("--threads", options->threads, "CPU threads")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  app->add_option("--seconds", options->seconds, "About so long each stage is measured")
      ->check(CLI::Range(0.0, 3600.0))
      ->capture_default_str();
  app->add_option("--json", *json_file, "Write the figures to this file, too");
}

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

int main(int argc, char** argv) {
  CLI::App app("How fast training's stages run here, against the machine's matrix products");
  TrainBenchOptions options;
  std::string json_file;
  AddOptions(&app, &options, &json_file);
  return prospect::tools::RunProgram("prospect bench train", &app, argc, argv, [&] {
    const json figures = prospect::tools::BenchTraining(options);
    Print(figures);
    if (!json_file.empty()) prospect::base::WriteJsonFile(json_file, figures);
    return 0;
  });
}
