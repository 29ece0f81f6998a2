#include "services/from_log/command.h"

#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/exit_error.h"
#include "cli/report_file.h"
#include "model/dataset.h"
#include "services/from_log/log_importer.h"

namespace prospect::services {
namespace {

namespace fs = std::filesystem;

// A folder for the files of single trials beside the data set, removed with the object.
class Parts {
 public:
  explicit Parts(const std::string& out) : folder_(out + ".parts" + std::to_string(getpid())) {
    std::error_code error;
    fs::create_directories(folder_, error);
    if (error) throw ExitError(kExitDisk, folder_ + " cannot be made: choose another --out");
  }
  ~Parts() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  Parts(const Parts&) = delete;
  Parts& operator=(const Parts&) = delete;

  // Refused by the data set's rules: DataError. The disk at fault: DiskError.
  void Write(const model::Trial& trial) {
    const std::string path = folder_ + "/trial_" + std::to_string(trial.seed) + ".h5";
    model::WriteTrialFile(path, trial);
    files_.push_back(path);
  }

  const std::vector<std::string>& files() const { return files_; }

 private:
  std::string folder_;
  std::vector<std::string> files_;
};

struct LogCounts {
  std::int64_t events = 0;
  std::int64_t damaged = 0;
};

LogCounts ReadLogs(const std::vector<std::string>& paths, LogImporter& importer) {
  LogCounts counts;
  for (const std::string& path : paths) {
    EventLog log(path);
    LogEvent event;
    while (log.Next(event)) importer.Take(event);
    importer.EndOfLog();
    counts.events += log.events();
    counts.damaged += log.damaged();
  }
  return counts;
}

void Print(const LogImporter& importer, const LogCounts& counts, std::size_t trials) {
  for (const ImportRow& row : importer.rows()) {
    std::printf("episode %lld: %lld frames, %s%s%s\n", static_cast<long long>(row.episode_id),
                static_cast<long long>(row.frames), row.outcome.c_str(),
                row.reason.empty() ? "" : ": ", row.reason.c_str());
  }
  for (const auto& [reason, count] : importer.refused()) {
    std::printf("%lld messages refused: %s\n", static_cast<long long>(count), reason.c_str());
  }
  std::printf("%lld events, %lld damaged places, %zu trials\n",
              static_cast<long long>(counts.events), static_cast<long long>(counts.damaged),
              trials);
}

// Keys: events, damaged, trials, messages_refused {"CHANNEL: reason": n}, rows [{episode, frames,
// outcome, reason}].
nlohmann::json Report(const LogImporter& importer, const LogCounts& counts, std::size_t trials) {
  nlohmann::json report = {{"events", counts.events},
                           {"damaged", counts.damaged},
                           {"trials", trials},
                           {"messages_refused", importer.refused()},
                           {"rows", nlohmann::json::array()}};
  for (const ImportRow& row : importer.rows()) {
    report["rows"].push_back({{"episode", row.episode_id},
                              {"frames", row.frames},
                              {"outcome", row.outcome},
                              {"reason", row.reason}});
  }
  return report;
}

void Pack(const std::vector<std::string>& files, const std::string& out) {
  if (files.empty())
    throw ExitError(kExitDataFile, "the logs hold no whole trial: nothing was written");
  try {
    model::PackTrialFiles(files, out);
  } catch (const model::DataError& error) {
    throw ExitError(kExitDataFile, error.what());
  }
}

}  // namespace

int RunFromLog(const cli::DatasetFromLogOptions& options) {
  Parts parts(options.out);
  LogImporter importer([&](const model::Trial& trial) { parts.Write(trial); });
  const LogCounts counts = ReadLogs(options.logs, importer);
  const std::size_t trials = parts.files().size();
  if (options.report.talks()) Print(importer, counts, trials);
  cli::WriteReport(options.report, Report(importer, counts, trials));
  Pack(parts.files(), options.out);
  return kExitSuccess;
}

}  // namespace prospect::services
