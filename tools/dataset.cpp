// prospect-dataset: what a data set holds, joining trial files, a sheet of its pictures
// (docs/training.md).

#include <CLI/CLI.hpp>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "base/atomic_file.h"
#include "base/child_process.h"
#include "base/json_file.h"
#include "model/dataset.h"
#include "report/png.h"
#include "tools/common/program.h"
#include "tools/dataset/info.h"
#include "tools/dataset/sheet.h"

namespace prospect {
namespace {

namespace fs = std::filesystem;

constexpr int kSignalled = 128;  // and the signal: the status of what one has ended

int Info(const std::string& path, const std::string& json_file) {
  const tools::DataSetInfo info = tools::Inspect(model::TrialFile(path));
  tools::PrintInfo(info, stdout);
  if (json_file.empty()) return 0;
  base::WriteJsonFile(json_file, tools::InfoJson(info));
  return 0;
}

/// Files as named; of folders every *.h5 inside.
std::vector<std::string> Expand(const std::vector<std::string>& inputs) {
  std::vector<std::string> files;
  for (const std::string& input : inputs) {
    if (!fs::is_directory(input)) {
      files.push_back(input);
      continue;
    }
    for (const auto& entry : fs::directory_iterator(input)) {
      const bool hidden = entry.path().filename().string().front() == '.';  // half written
      if (!hidden && entry.path().extension() == ".h5") files.push_back(entry.path().string());
    }
  }
  return files;
}

const std::map<std::string, model::Split> kSplits = {{"train", model::Split::kTrain},
                                                     {"valid", model::Split::kValid},
                                                     {"test", model::Split::kTest}};

int Pack(const std::vector<std::string>& inputs, const std::string& out, const std::string& split,
         std::size_t most) {
  model::PackChoice choice;
  if (!split.empty()) choice.split = kSplits.at(split);
  if (most > 0) choice.most = most;
  const std::size_t trials = model::PackTrialFiles(Expand(inputs), out, choice);
  std::printf("%zu trials in %s\n", trials, out.c_str());
  return 0;
}

int WriteSheet(const std::string& path, const std::string& out, std::size_t rows,
               std::uint64_t seed) {
  report::WritePng(out, tools::ContactSheet(model::TrialFile(path), rows, seed));
  std::printf("%s: a trial a row, the first picture of each action, and the last\n", out.c_str());
  return 0;
}

struct Arguments {
  std::string file, out, json_file;
  std::vector<std::string> inputs;
  std::string split;
  std::size_t rows = 12, trials = 0;
  std::uint64_t seed = 0;
};

int Dispatch(const CLI::App& app, const Arguments& a) {
  if (app.got_subcommand("info")) return Info(a.file, a.json_file);
  if (app.got_subcommand("pack")) return Pack(a.inputs, a.out, a.split, a.trials);
  return WriteSheet(a.file, a.out, a.rows, a.seed);
}

void AddCommands(CLI::App* app, Arguments* a) {
  app->require_subcommand(1);
  CLI::App* info = app->add_subcommand("info", "what a data set holds");
  info->add_option("FILE", a->file, "the data set")->required();
  info->add_option("--json", a->json_file, "write it here, too");
  CLI::App* pack = app->add_subcommand("pack", "joins trial files into one data set");
  pack->add_option("INPUTS", a->inputs, "trial files, data sets, or folders of them")->required();
  pack->add_option("--out", a->out, "the data set to write")->required();
  pack->add_option("--split", a->split, "only trials of this part: train, valid or test")
      ->check(CLI::IsMember(kSplits));
  pack->add_option("--trials", a->trials, "only the first so many of them, by seed")
      ->check(CLI::PositiveNumber);
  CLI::App* sheet = app->add_subcommand("sheet", "a picture of trials: a row each");
  sheet->add_option("FILE", a->file, "the data set")->required();
  sheet->add_option("--out", a->out, "the PNG to write")->required();
  sheet->add_option("--rows", a->rows, "trials to show")->check(CLI::Range(1, 200));
  sheet->add_option("--seed", a->seed, "which trials are drawn");
}

int RunHere(const CLI::App& app, const Arguments& a) {
  return RunMain([&] { return Dispatch(app, a); }, "prospect-dataset", kExitDisk);
}

// What a child that crashed left of the data set it wrote: whoever takes the same name next,
// removes it.
void RemoveHalf(const std::string& out) {
  if (out.empty()) return;
  try {
    const base::AtomicFile abandoned(out);
  } catch (const base::DiskError&) {
    // Then nothing was begun.
  }
}

// libhdf5 crashes on some damaged files (its H5Ocopy above all), so that a child does the work.
int RunApart(const CLI::App& app, const Arguments& a) {
  const auto work = [&] {
    const int code = RunHere(app, a);
    std::fflush(nullptr);
    return code;
  };
  const int status = base::ChildProcess(work).Wait();
  if (status <= kSignalled) return status;
  RemoveHalf(a.out);
  std::fprintf(
      stderr,
      "prospect-dataset: libhdf5 was stopped by '%s' on a damaged file: leave out files in "
      "turn to find it, and make it anew\n",
      strsignal(status - kSignalled));
  return kExitDataFile;
}

}  // namespace
}  // namespace prospect

int main(int argc, char** argv) {
  CLI::App app("Data sets: what they hold, joining them, a sheet of their pictures.");
  prospect::Arguments arguments;
  prospect::AddCommands(&app, &arguments);
  return prospect::tools::RunProgram("prospect-dataset", &app, argc, argv,
                                     [&] { return prospect::RunApart(app, arguments); });
}
