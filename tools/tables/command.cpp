#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/atomic_file.h"
#include "base/hash.h"
#include "base/lock.h"
#include "base/quiet.h"
#include "base/stop_signals.h"
#include "model/training/export.h"
#include "model/training/variants.h"
#include "model/weights.h"
#include "tools/common/extent.h"
#include "tools/common/progress.h"
#include "tools/tables/report.h"
#include "tools/tables/row_cache.h"
#include "tools/train/commands.h"

namespace prospect::tools {
namespace {

namespace fs = std::filesystem;

constexpr int kBaselines = 3;  // rows

struct Candidate {
  std::string name;  // as the row is called
  std::string path;  // of its weights file; empty = not trained
};

std::vector<Candidate> CandidatesOf(const cli::TablesOptions& a) {
  std::vector<Candidate> all;
  if (!a.models.empty()) {
    for (const model::Variant& variant : model::Variants()) {
      const std::string path = a.models + "/" + variant.name + "/" + a.task + ".safetensors";
      all.push_back({variant.in_table, fs::exists(path) ? path : ""});
    }
  }
  if (!a.weights.empty()) all.push_back({fs::path(a.weights).filename().string(), a.weights});
  return all;
}

TableData DataOf(const cli::TablesOptions& a) {
  TableData data;
  data.path = a.data;
  data.every = a.every;
  data.paper_tail = a.paper_tail;
  data.trials = static_cast<std::size_t>(a.trials);
  data.threads = a.threads;
  return data;
}

struct LoadedModel {
  model::Networks networks;
  nlohmann::json metadata;
};

LoadedModel Load(const std::string& path, const std::string& task) {
  const nlohmann::json metadata = model::ReadWeights(path).metadata;
  if (metadata.value("task", "") != task) {
    throw model::WeightsError(path + ": is not of task '" + task + "'");
  }
  LoadedModel loaded{model::Networks(metadata.at("network").get<model::NetworkConfig>()), metadata};
  model::LoadNetworks(path, &loaded.networks);
  return loaded;
}

class Tables {
 public:
  explicit Tables(const cli::TablesOptions& a)
      : a_(a), data_(DataOf(a)), own_(base::LockFolder(a.out)), candidates_(CandidatesOf(a)) {
    for (const Candidate& candidate : candidates_) {
      if (!candidate.path.empty() && first_.empty()) first_ = candidate.path;
    }
    if (first_.empty()) {
      throw std::invalid_argument(
          "nothing to evaluate: give --weights FILE, or --models with "
          "VARIANT/" +
          a.task + ".safetensors inside");
    }
    if (a_.judge.empty() && model::ReadsLabels(model::ReadWeights(first_))) {
      a_.judge = model::ClassifiersPath(first_);
    }
    data_hash_ = model::TrialFile(a.data).ContentHash();
    fs::create_directories(a.out + "/rows");
    at::set_num_threads(1);  // trials are the parallelism
  }

  // @return the exit code
  int Run() {
    const LoadedModel first = Load(first_, a_.task);
    if (!a_.judge.empty()) {
      judge_ = first.networks.second_classifier;
      model::LoadModule(a_.judge, "second_classifier", judge_.ptr().get());
    }
    // Of a row that is stopped nothing is kept; the rows before it are in the tables.
    try {
      AddBaselines(first.networks);
      for (const Candidate& candidate : candidates_) AddModel(candidate);
    } catch (const Interrupted&) {
    }
    const Extent extent{static_cast<int>(lines_.size()),
                        static_cast<int>(candidates_.size()) + kBaselines};
    if (lines_.empty()) throw Interrupted(extent.Words("rows") + "; no tables were written");
    Write(extent);
    return extent.exit_code();
  }

 private:
  // Everything that a row depends on.
  std::string KeyOf(const std::string& what, const std::string& weights) const {
    const nlohmann::json key = {"row-3",
                                what,
                                model::WeightsFileHash(weights),
                                data_hash_,
                                a_.judge.empty() ? 0 : model::WeightsFileHash(a_.judge),
                                data_.every,
                                data_.trials,
                                data_.paper_tail};
    return base::HexText(base::HashText(key.dump()));
  }

  std::vector<Row> RowsOf(const std::string& what, const std::string& weights,
                          const std::function<std::vector<Row>(const ScoreProgress&)>& make) const {
    const std::string key = KeyOf(what, weights);
    return CachedRows(a_.out + "/rows/" + key + ".json", key, [&] {
      std::unique_ptr<Progress> bar;
      return make([&](int done, int total) {
        if (base::StopRequested() && done < total) throw Interrupted("stopped within " + what);
        if (!bar) bar = std::make_unique<Progress>("trials of " + what, total);
        bar->Step();
      });
    });
  }

  void AddBaselines(const model::Networks& networks) {
    const auto rows = RowsOf("baselines", first_, [&](const ScoreProgress& progress) {
      const Baselines b = ScoreBaselines(data_, networks, judge_, progress);
      return std::vector<Row>{b.copy, b.reconstruction, b.goal};
    });
    lines_.push_back({"copy x", rows.at(0)});
    lines_.push_back({"decode(encode(goal))", rows.at(1)});
    lines_.push_back({"the goal itself, with sensor noise", rows.at(2)});
  }

  void AddModel(const Candidate& candidate) {
    Line line;
    line.name = candidate.name;
    line.is_model = true;
    if (!candidate.path.empty()) {
      const LoadedModel loaded = Load(candidate.path, a_.task);
      line.row = RowsOf(candidate.name, candidate.path, [&](const ScoreProgress& progress) {
                   return std::vector<Row>{ScoreModel(data_, loaded.networks, judge_, progress)};
                 }).at(0);
      ReadEffort(loaded.metadata, &line);
    }
    lines_.push_back(std::move(line));
  }

  static void ReadEffort(const nlohmann::json& metadata, Line* line) {
    for (const char* stage : {"transform_hidden", "transform_image"}) {
      line->iterations += metadata.at("train").at(stage).at("iterations").get<std::int64_t>();
    }
    const nlohmann::json stages = metadata.value("stages", nlohmann::json::object());
    for (const char* stage : {"transform-hidden", "transform-image"}) {
      if (stages.contains(stage)) line->seconds += stages[stage].at("seconds").get<double>();
    }
  }

  std::string Caption() const {
    std::string text = "Held-out trials of task " + a_.task + " (data " + data_hash_ +
                       "): one example a frame during an action";
    if (data_.every > 1) text += ", every " + std::to_string(data_.every) + "th of them";
    text += data_.paper_tail ? ", last actions twice" : ", last actions left out";
    text += ". Errors against the clean goal pictures; ";
    text += a_.judge.empty() ? "nobody reads labels."
                             : "labels read by a second classifier that is in no loss.";
    return text +
           " Brackets: 95 % by drawing trials anew. 'Composed' keeps what was seen where decoding "
           "shows no change; it and C's own label are taken of every fifth example.\n";
  }

  // Whom the others are compared with: L1 (two linked steps, nothing else), else the first trained.
  // Null: none was scored, as after a stop.
  const Line* Reference() const {
    const Line* first = nullptr;
    for (const Line& line : lines_) {
      if (!line.is_model || !line.row) continue;
      if (line.name == "L1") return &line;
      if (first == nullptr) first = &line;
    }
    return first;
  }

  void Write(const Extent& extent) const {
    std::string text = "# Predicted pictures\n\n" + Caption() +
                       (extent.stopped() ? "\n**" + extent.Words("rows") + "**\n" : "") +
                       "\n## Successful trials only\n\n" + MarkdownTable(lines_, true) +
                       "\n## All trials\n\n" + MarkdownTable(lines_, false);
    const Line* reference = Reference();
    const std::string differences =
        reference == nullptr ? "" : DifferencesTable(lines_, *reference);
    if (!differences.empty()) text += "\n## Differences, on the same trials\n\n" + differences;
    base::WriteFile(a_.out + "/tables.md", text);
    base::WriteFile(a_.out + "/tables.csv", CsvTables(lines_));
    if (!base::Quiet())
      std::printf("%s\n%s/tables.md and tables.csv\n", text.c_str(), a_.out.c_str());
  }

  cli::TablesOptions a_;
  TableData data_;
  base::Lock own_;  // of the folder
  std::vector<Candidate> candidates_;
  std::string first_;  // weights file of the first row that is trained
  std::string data_hash_;
  model::Classifier judge_{nullptr};
  std::vector<Line> lines_;
};

}  // namespace

int RunTables(const cli::TablesOptions& options) {
  base::InstallStopSignals();
  return Tables(options).Run();
}

}  // namespace prospect::tools
