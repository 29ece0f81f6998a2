// prospect-verify: measures again what docs/results.md says of the bundled weights.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <thread>

#include "base/child_process.h"
#include "base/lock.h"
#include "base/quiet.h"
#include "base/run_main.h"
#include "cli/commands/verify.h"
#include "cli/installation.h"
#include "cli/program.h"
#include "cli/report_file.h"
#include "tools/verify/figures.h"
#include "tools/verify/tables.h"

namespace {

using namespace prospect;
using namespace prospect::verify;
using nlohmann::json;
using Options = cli::VerifyOptions;
namespace fs = std::filesystem;

// Its stdout goes to a file; its stderr, where it shows progress, stays the terminal's.
int RunCommand(const std::vector<std::string>& command, const std::string& log) {
  const base::Descriptor output = base::OpenOutput(log);
  base::ChildOptions options;
  options.command = command;
  options.out = output.get();
  return base::ChildProcess(options).Wait();
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
    command.insert(command.begin(), base::ProgramBeside("prospect"));
    if (base::Quiet()) command.push_back("--quiet");
    const std::string log = folder + "/" + words[0] + ".log";
    const int code = RunCommand(command, log);
    if (code != 0) {
      throw ExitError(ExitCode(code),
                      words[0] + " ended with exit code " + std::to_string(code) + "; see " + log);
    }
  }
  return ReadReport(report);
}

// A line of the table.
void Print(const Figure& figure, const Verdict& verdict) {
  std::printf("  %-48s %9.4f  %s %9.4f", figure.name.c_str(), verdict.measured,
              figure.at_most ? "at most " : "expected", verdict.expected);
  if (!figure.at_most) std::printf(" +- %.4f", figure.tolerance);
  std::printf("%s\n", verdict.within ? "" : "   OUTSIDE");
}

// Prints a measurement's figures. @return how many lie outside
int Show(const Measurement& measurement, bool full, const json& report, json* told) {
  int outside = 0;
  for (const Figure& figure : measurement.figures) {
    const Verdict verdict = Judge(figure, full, report);
    outside += verdict.within ? 0 : 1;
    if (!base::Quiet()) Print(figure, verdict);
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

// What is published and was not looked at; an installation without docs has no list.
json TellTablesNotMeasured(const std::vector<Measurement>& measurements) {
  std::ifstream in(cli::DataFolder("docs") + "/results.md");
  const std::string markdown((std::istreambuf_iterator<char>(in)), {});
  const std::vector<std::string> tables = TablesNotMeasured(markdown, measurements);
  if (base::Quiet() || tables.empty()) return tables;
  std::printf("Tables of docs/results.md that were not measured again:\n");
  for (const std::string& table : tables) std::printf("  %s\n", table.c_str());
  return tables;
}

int Run(const Options& options) {
  const base::Lock own = base::LockFolder(options.work);
  const auto begin = std::chrono::steady_clock::now();
  json told = json::array();
  int outside = 0, count = 0;
  const std::vector<Measurement> measurements = ReadMeasurements(options.figures);
  for (const Measurement& measurement : measurements) {
    if (!base::Quiet()) std::printf("%s\n", measurement.name.c_str());
    std::fflush(stdout);
    const std::string folder = options.work + "/" + std::to_string(++count);
    outside += Show(measurement, options.full, Measure(measurement, options, folder), &told);
  }
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  if (!base::Quiet())
    std::printf("%zu figures, %d outside their tolerance; %.0f s\n", told.size(), outside,
                took.count());
  const json tables = TellTablesNotMeasured(measurements);
  cli::WriteReport(options.report, {{"outside", outside},
                                    {"full", options.full},
                                    {"rows", told},
                                    {"tables_not_measured", tables}});
  return outside == 0 ? kExitSuccess : kExitTolerance;
}

// What was not given is that of the bundled weights.
void Complete(Options* options) {
  if (options->figures.empty()) options->figures = cli::DataFolder("config") + "/figures.yaml";
  if (options->weights.empty()) options->weights = cli::DataFolder("model/weights");
  if (options->held_out.empty()) options->held_out = cli::DataFolder("model/held_out");
  if (options->jobs == 0) {
    options->jobs = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  }
  if (!options->work.empty()) return;
  const char* data = std::getenv("PROSPECT_DATA");
  const char* home = std::getenv("HOME");
  options->work =
      (data ? std::string(data) : std::string(home ? home : ".") + "/.cache/prospect") + "/verify";
}

int Verify(const Options& options) {
  Options complete = options;
  Complete(&complete);
  return Run(complete);
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<cli::Part> parts = {cli::Carries("", "verify", Verify)};
  return RunMain([&] { return cli::RunPart(argc, argv, parts); }, "prospect-verify",
                 kExitTaskFailure);
}
