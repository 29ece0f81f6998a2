#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>

#include "cli/report_file.h"
#include "tools/bench/engine_bench.h"
#include "tools/train/commands.h"

namespace prospect::tools {
namespace {

using nlohmann::json;

void PrintPair(const std::string& what, const json& pair) {
  std::printf("%-14s %9.3f %12.3f %7.1f", what.c_str(), pair["ms"].get<double>(),
              pair["torch_ms"].get<double>(), pair["ratio"].get<double>());
}

void PrintAgreement(const json& agreement) {
  std::printf(
      "Beside libtorch's answers in %d imagined states of %d scenes, largest difference: %.1e in "
      "V, "
      "f, Q and p, %.1e in a state, %.1e in a picture.\n",
      agreement["states"].get<int>(), agreement["scenes"].get<int>(),
      agreement["judged"].get<double>(), agreement["state"].get<double>(),
      agreement["picture"].get<double>());
  if (agreement["decisions"] == 0) return;
  std::printf("Plans: %d of %d differ", agreement["differing"].get<int>(),
              agreement["decisions"].get<int>());
  if (agreement["differing"] != 0)
    std::printf(", whose scores lie %.1e apart at most", agreement["tie"].get<double>());
  std::printf(".\n");
}

void Print(const json& figures) {
  std::printf("%-14s %9s %12s %7s %7s\n", "", "ms", "libtorch ms", "ratio", "peak");
  for (const json& row : figures["rows"]) {
    PrintPair("row of " + std::to_string(row["batch"].get<int>()), row);
    std::printf(" %5.0f %%\n", 100 * row["peak_share"].get<double>());
  }
  for (const char* what : {"encode", "decode"}) {
    PrintPair(what, figures[what]);
    std::printf("\n");
  }
  std::printf("\n%-14s %6s %9s %9s %7s\n", "layer", "batch", "us a row", "MMA", "peak");
  for (const json& row : figures["layers"]) {
    std::printf("%-14s %6d %9.2f %9.3f %5.0f %%\n", row["layer"].get<std::string>().c_str(),
                row["batch"].get<int>(), row["us"].get<double>(),
                1e-6 * row["multiply_adds"].get<double>(), 100 * row["peak_share"].get<double>());
  }
  std::printf(
      "%s, %s, processor time of one thread, medians of %d; large matrix products: %.1f GFLOP/s. "
      "MMA: million multiply-adds a row, as the windows have them.\n",
      figures["task"].get<std::string>().c_str(), figures["engine"].get<std::string>().c_str(),
      figures["pairs"].get<int>(), figures["matrix_product_gflops"].get<double>());
  PrintAgreement(figures["agreement"]);
}

}  // namespace

int RunBenchEngine(const cli::BenchEngineOptions& options) {
  const json figures = BenchEngine(options);
  if (options.report.talks()) Print(figures);
  cli::WriteReport(options.report, figures);
  return 0;
}

}  // namespace prospect::tools
