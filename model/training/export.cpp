#include "model/training/export.h"

#include <filesystem>

#include "model/weights.h"

#ifndef PROSPECT_VERSION
#error "the build defines PROSPECT_VERSION"
#endif

namespace prospect::model {
namespace {

using nlohmann::json;

json StagesOf(const Trainer& trainer) {
  json stages = json::object();
  for (const StageSummary& stage : trainer.stages()) {
    stages[stage.name] = {
        {"iterations", stage.iterations}, {"batch", stage.batch}, {"seconds", stage.seconds}};
  }
  return stages;
}

/// How the weights that training began from were made, the first ones first.
json HistoryOf(const Trainer& trainer) {
  if (trainer.options().from.empty()) return json::array();
  const json before = ReadWeights(trainer.options().from).metadata;
  json history = before.value("history", json::array());
  json last = json::object();
  for (const char* key : {"command", "variant", "train", "stages", "data_hash"}) {
    if (before.contains(key)) last[key] = before[key];
  }
  history.push_back(last);
  return history;
}

json CalibrationBy(const json& scores) {
  if (!scores.contains("plan")) return json::object();
  return {{"refusal_threshold", scores["plan"]["threshold"]}};
}

json MetadataOf(const Trainer& trainer, const json& scores) {
  const TrainContext& context = trainer.context();
  return {{"format", "prospect-weights-1"},
          {"task", context.samples.task},
          {"task_hash", context.samples.task_hash},
          {"world_version", context.samples.world_version},
          {"num_actions", context.samples.num_actions},
          {"trials", context.samples.trials.size()},
          {"trial_seeds", {trainer.file().seeds().front(), trainer.file().seeds().back()}},
          {"command", trainer.options().command},
          {"history", HistoryOf(trainer)},
          {"network", context.config.network},
          {"train", context.config},
          {"variant", trainer.options().variant},
          {"reads_labels", context.networks.has_second_classifier},
          {"stages", StagesOf(trainer)},
          {"data_hash", trainer.data_hash()},
          {"code_version", PROSPECT_VERSION},
          {"scores", scores},
          {"calibration", CalibrationBy(scores)}};
}

bool IsClassifier(const std::string& name) {
  return name == "classifier" || name == "second_classifier";
}

}  // namespace

std::string ClassifiersPath(const std::string& weights) {
  const std::filesystem::path path(weights);
  return (path.parent_path() / (path.stem().string() + "-classifiers" + path.extension().string()))
      .string();
}

bool ReadsLabels(const WeightsFile& weights) {
  const json train = weights.metadata.value("train", json::object());
  const json classifier = train.value("classifier", json::object());
  // Older files do not say.
  return weights.metadata.value("reads_labels", classifier.value("iterations", 1) > 0);
}

void LoadNetworks(const std::string& weights, Networks* networks) {
  const WeightsFile planning = ReadWeights(weights);
  const std::string beside = ClassifiersPath(weights);
  const WeightsFile classifiers = ReadsLabels(planning) ? ReadWeights(beside) : WeightsFile();
  networks->has_classifier = HasModule(classifiers, "classifier");
  networks->has_second_classifier = ReadsLabels(planning);
  networks->has_heads = HasModule(planning, "value");
  for (const auto& [name, module] : networks->named()) {
    if (!networks->Has(name)) continue;
    const bool here = HasModule(planning, name);
    module->to(torch::kCPU);
    LoadModule(here ? planning : classifiers, here ? weights : beside, name, module);
  }
  networks->SetTraining(false);
}

void BundleWeights(const std::string& weights, const std::string& folder) {
  const std::filesystem::path to =
      std::filesystem::path(folder) / std::filesystem::path(weights).filename();
  std::filesystem::create_directories(folder);
  const WeightsFile planning = ReadWeights(weights);
  WriteWeights(to.string(), planning.tensors, planning.metadata);
  if (!ReadsLabels(planning)) return;
  WeightsFile classifiers = ReadWeights(ClassifiersPath(weights));
  const auto is_c = [](const std::string& name) { return name.starts_with("classifier."); };
  for (auto it = classifiers.tensors.begin(); it != classifiers.tensors.end();) {
    it = is_c(it->first) ? classifiers.tensors.erase(it) : std::next(it);
  }
  WriteWeights(ClassifiersPath(to.string()), classifiers.tensors, classifiers.metadata);
}

std::string ExportWeights(const Trainer& trainer, const json& scores) {
  const TrainContext& context = trainer.context();
  std::map<std::string, torch::Tensor> planning, classifiers;
  for (const auto& [name, module] : context.networks.named()) {
    if (!context.networks.Has(name)) continue;
    CollectTensors(name, *module, IsClassifier(name) ? &classifiers : &planning);
  }
  const json metadata = MetadataOf(trainer, scores);
  const std::string weights =
      trainer.weights_folder() + "/" + context.samples.task + ".safetensors";
  if (!classifiers.empty()) WriteWeights(ClassifiersPath(weights), classifiers, metadata);
  WriteWeights(weights, planning, metadata);
  return weights;
}

}  // namespace prospect::model
