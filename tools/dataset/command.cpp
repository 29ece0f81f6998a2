#include <cstdio>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "base/atomic_file.h"
#include "base/quiet.h"
#include "cli/options/task.h"
#include "cli/report_file.h"
#include "model/dataset.h"
#include "model/robomimic/export.h"
#include "report/png.h"
#include "tools/common/parts.h"
#include "tools/common/same_table.h"
#include "tools/data/commands.h"
#include "tools/dataset/apart.h"
#include "tools/dataset/info.h"
#include "tools/dataset/sheet.h"

namespace prospect::tools {
namespace {

namespace fs = std::filesystem;

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

model::PackChoice ChoiceOf(const cli::DatasetPackOptions& options) {
  static const std::map<std::string, model::Split> splits = {{"train", model::Split::kTrain},
                                                             {"valid", model::Split::kValid},
                                                             {"test", model::Split::kTest}};
  model::PackChoice choice;
  if (!options.split.empty()) choice.split = splits.at(options.split);
  if (options.trials > 0) choice.most = static_cast<std::size_t>(options.trials);
  return choice;
}

/// The table that the data were recorded with: of the task that is named, or of the installed one
/// of that name where it is the same. Null: neither.
const sim::TaskSpec* TableOf(const std::string& task, const model::TrialFile& data) {
  if (!task.empty()) {
    RequireSameTable(cli::TaskOf(task), data);
    return &cli::TaskOf(task).spec;
  }
  if (data.size() == 0) return nullptr;
  const model::Trial trial = data.ReadLabels(0);
  const tasks::TaskFile* installed = cli::InstalledTask(trial.task);
  return installed && TableDifference(*installed, trial).empty() ? &installed->spec : nullptr;
}

/// Throws PartError, DataError.
Part PartOfFile(const std::string& file) {
  const model::TrialFile trials(file);
  if (trials.shard().empty())
    throw PartError(file + ": is no part of a run: it was made without --shard");
  const Part part = PartFrom(trials.shard(), file);
  if (trials.size() != static_cast<std::size_t>(SizeOf(part)))
    throw PartError(file + ": does not hold its trials; damaged: make this part anew");
  return part;
}

}  // namespace

int RunInfo(const cli::DatasetInfoOptions& options) {
  const auto work = [&] {
    const model::TrialFile file(options.file);
    const DataSetInfo info = Inspect(file, TableOf(options.task, file));
    if (options.report.talks()) PrintInfo(info, stdout);
    cli::WriteReport(options.report, InfoJson(info));
    return 0;
  };
  return RunApart(work, "");
}

int RunPack(const cli::DatasetPackOptions& options) {
  const auto work = [&] {
    const std::size_t trials =
        model::PackTrialFiles(Expand(options.inputs), options.out, ChoiceOf(options));
    if (!base::Quiet()) std::printf("%zu trials in %s\n", trials, options.out.c_str());
    return 0;
  };
  return RunApart(work, options.out);
}

int RunMergeTrials(const cli::MergeOptions& options) {
  const auto work = [&] {
    std::vector<NamedPart> parts;
    for (const std::string& file : options.parts) parts.push_back({file, PartOfFile(file)});
    RequireOneRun(parts);
    const std::size_t trials = model::PackTrialFiles(options.parts, options.out);
    if (!base::Quiet()) std::printf("%zu trials in %s\n", trials, options.out.c_str());
    return 0;
  };
  return RunApart(work, options.out);
}

int RunExport(const cli::DatasetExportOptions& options) {
  const auto work = [&] {
    const model::TrialFile trials(options.file);
    model::robomimic::Export(trials, options.out, options.next_obs);
    if (!options.segments.empty())
      base::WriteFile(options.segments, model::robomimic::SegmentTable(trials));
    if (!base::Quiet()) std::printf("%zu trials in %s\n", trials.size(), options.out.c_str());
    return 0;
  };
  return RunApart(work, options.out);
}

int RunSheet(const cli::DatasetSheetOptions& options) {
  const auto work = [&] {
    const auto rows = static_cast<std::size_t>(options.rows);
    const model::TrialFile file(options.file);
    report::WritePng(options.out,
                     ContactSheet(file, TableOf(options.task, file), rows, options.seed));
    if (!base::Quiet())
      std::printf("%s: a trial a row, the first picture of each action, and the last\n",
                  options.out.c_str());
    return 0;
  };
  return RunApart(work, options.out);
}

}  // namespace prospect::tools
