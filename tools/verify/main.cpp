// prospect-verify: measures again what docs/results.md says of the bundled weights.

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "base/child_process.h"
#include "base/json_file.h"
#include "base/lock.h"
#include "tools/common/program.h"
#include "tools/verify/figures.h"

namespace {

using namespace prospect::verify;
using nlohmann::json;
namespace fs = std::filesystem;

struct Options {
  std::string figures, weights, held_out, work, json_file;
  bool full = false;
  int jobs = 2;
};

void AddOptions(CLI::App* app, Options* options) {
  app->add_option("--figures", options->figures,
                  "What to measure, and what docs/results.md says of it")
      ->required()
      ->check(CLI::ExistingFile);
  app->add_option("--weights", options->weights, "Folder of weights, TASK.safetensors each")
      ->required();
  app->add_option("--held-out", options->held_out, "Folder of held-out trials, TASK.h5 each")
      ->required();
  app->add_option("--work", options->work, "Folder for trials and reports")->required();
  app->add_flag("--full", options->full, "Everything, as in docs/results.md: hours");
  app->add_option("--jobs", options->jobs, "Processes")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  app->add_option("--json", options->json_file, "Write figures and verdicts to this file, too");
}

// Its stdout goes to a file; its stderr, where it shows progress, stays the terminal's.
int RunCommand(const std::vector<std::string>& command, const std::string& log) {
  const prospect::base::Descriptor output = prospect::base::OpenOutput(log);
  prospect::base::ChildOptions options;
  options.command = command;
  options.out = output.get();
  return prospect::base::ChildProcess(options).Wait();
}

json ReadReport(const std::string& path) {
  std::ifstream in(path);
  json report = json::parse(in, nullptr, false);
  if (report.is_discarded()) throw std::runtime_error(path + ": no report was written");
  return report;
}

// Runs a measurement's commands and reads the last one's report.
json Measure(const Measurement& measurement, const Options& options, const std::string& folder) {
  std::map<std::string, std::string> values = options.full ? measurement.full : measurement.quick;
  const std::string report = folder + "/report.json";
  values.insert({{"weights", options.weights},
                 {"held_out", options.held_out},
                 {"work", options.work},
                 {"report", report},
                 {"jobs", std::to_string(options.jobs)}});
  fs::remove(report);
  fs::create_directories(folder);
  for (const auto& words : measurement.commands) {
    std::vector<std::string> command = Fill(words, values);
    command[0] = prospect::base::ProgramBeside("prospect-" + command[0]);
    const std::string log = folder + "/" + words[0] + ".log";
    const int code = RunCommand(command, log);
    if (code != 0) {
      throw prospect::ExitError(
          prospect::ExitCode(code),
          words[0] + " ended with exit code " + std::to_string(code) + "; see " + log);
    }
  }
  return ReadReport(report);
}

// Prints a measurement's figures. @return how many lie outside
int Show(const Measurement& measurement, bool full, const json& report, json* told) {
  int outside = 0;
  for (const Figure& figure : measurement.figures) {
    const Verdict verdict = Judge(figure, full, report);
    outside += verdict.within ? 0 : 1;
    std::printf("  %-48s %9.4f  %s %9.4f", figure.name.c_str(), verdict.measured,
                figure.at_most ? "at most " : "expected", verdict.expected);
    if (!figure.at_most) std::printf(" +- %.4f", figure.tolerance);
    std::printf("%s\n", verdict.within ? "" : "   OUTSIDE");
    told->push_back({{"measurement", measurement.name},
                     {"name", figure.name},
                     {"measured", verdict.measured},
                     {"expected", verdict.expected},
                     {"tolerance", figure.at_most ? 0 : figure.tolerance},
                     {"within", verdict.within}});
  }
  std::fflush(stdout);
  return outside;
}

int Run(const Options& options) {
  const prospect::base::Lock own = prospect::base::LockFolder(options.work);
  const auto begin = std::chrono::steady_clock::now();
  json told = json::array();
  int outside = 0, count = 0;
  for (const Measurement& measurement : ReadMeasurements(options.figures)) {
    std::printf("%s\n", measurement.name.c_str());
    std::fflush(stdout);
    const std::string folder = options.work + "/" + std::to_string(++count);
    outside += Show(measurement, options.full, Measure(measurement, options, folder), &told);
  }
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  std::printf("%zu figures, %d outside their tolerance; %.0f s\n", told.size(), outside,
              took.count());
  if (!options.json_file.empty()) {
    prospect::base::WriteJsonFile(options.json_file,
                                  {{"outside", outside}, {"full", options.full}, {"rows", told}});
  }
  return outside == 0 ? prospect::kExitSuccess : prospect::kExitTolerance;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Measures again the figures that docs/results.md gives for the bundled weights.");
  Options options;
  AddOptions(&app, &options);
  return prospect::tools::RunProgram(
      "prospect-verify", &app, argc, argv, [&] { return Run(options); },
      prospect::kExitTaskFailure);
}
