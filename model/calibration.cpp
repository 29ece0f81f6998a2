#include "model/calibration.h"

#include <algorithm>
#include <cmath>

#include "base/hash.h"
#include "model/refusal/scene_kind.h"
#include "model/weights_file.h"

namespace prospect::model {
namespace {

using nlohmann::json;

// One letter a scene: classes and endings in the order of their enumerations, from 1.
constexpr char kClasses[] = "shd", kEndings[] = "SFTR";
constexpr double kScoreSteps = 1e6;  // scores are stored to six decimals

template <class Kind>
char LetterOf(Kind kind, const char* letters) {
  return letters[static_cast<std::size_t>(kind) - 1];
}

// Throws std::out_of_range for a letter that is none.
template <class Kind>
Kind KindOf(char letter, const std::string& letters) {
  const std::size_t at = letters.find(letter);
  if (at == std::string::npos) throw std::out_of_range("an unknown letter");
  return static_cast<Kind>(at + 1);
}

json ToJson(const CalibrationSample& sample) {
  json scores = json::array();
  std::string classes, endings;
  for (const CalibrationScene& scene : sample.scenes) {
    scores.push_back(std::round(scene.score * kScoreSteps) / kScoreSteps);
    classes += LetterOf(scene.scene_class, kClasses);
    endings += LetterOf(scene.ending, kEndings);
  }
  return {{"scores", scores},
          {"classes", classes},
          {"endings", endings},
          {"rule", sample.rule},
          {"parameters", sample.parameters}};
}

CalibrationSample SampleFrom(const json& stored) {
  CalibrationSample sample;
  const auto scores = stored.at("scores").get<std::vector<double>>();
  const auto classes = stored.at("classes").get<std::string>();
  const auto endings = stored.at("endings").get<std::string>();
  for (std::size_t i = 0; i < scores.size(); ++i) {
    sample.scenes.push_back({scores[i], KindOf<SceneClass>(classes.at(i), kClasses),
                             KindOf<SceneEnding>(endings.at(i), kEndings)});
    if (!(scores[i] >= 0 && scores[i] <= 1)) throw std::out_of_range("a score beyond 0..1");
  }
  std::stable_sort(sample.scenes.begin(), sample.scenes.end(),
                   [](const auto& a, const auto& b) { return a.score < b.score; });
  sample.rule = stored.at("rule").get<std::string>();
  sample.parameters = stored.at("parameters").get<std::map<std::string, double>>();
  return sample;
}

std::optional<double> NumberIn(const json& stored, const char* name) {
  if (!stored.contains(name)) return std::nullopt;
  return stored.at(name).get<double>();
}

Calibration From(const json& stored) {
  Calibration calibration;
  calibration.refusal_threshold = stored.value("refusal_threshold", 0.0);
  calibration.alpha = NumberIn(stored, "alpha");
  calibration.epsilon = NumberIn(stored, "epsilon");
  calibration.delta = stored.value("delta", calibration.delta);
  calibration.scenes = stored.value("scenes", 0);
  calibration.command = stored.value("command", std::string());
  if (stored.contains("sample")) calibration.sample = SampleFrom(stored.at("sample"));
  calibration.sample.refusal_threshold = calibration.refusal_threshold;
  return calibration;
}

// Of a calibration that holds for networks whose tensors have this hash.
CalibrationSample SampleOrNone(const json& stored, const std::string& tensors) {
  try {
    if (stored.value("tensors", "") == tensors) return From(stored).sample;
  } catch (const std::exception&) {
    // Damaged: nothing of it is worth keeping.
  }
  return {};
}

// As it is stored with networks whose tensors have this hash.
json ToJson(const Calibration& calibration, std::uint64_t tensors) {
  json stored = {{"refusal_threshold", calibration.refusal_threshold},
                 {"scenes", calibration.scenes},
                 {"command", calibration.command}};
  if (calibration.alpha) stored["alpha"] = *calibration.alpha;
  if (calibration.epsilon) stored["epsilon"] = *calibration.epsilon;
  if (calibration.epsilon) stored["delta"] = calibration.delta;
  if (!calibration.sample.empty()) {
    stored["sample"] = ToJson(calibration.sample);
    stored["tensors"] = base::HexText(tensors);
  }
  return stored;
}

// One for each kind of scenes: a list, or the only one itself.
json ListIn(const json& metadata) {
  if (!metadata.contains("calibration")) return json::array();
  const json& stored = metadata.at("calibration");
  if (stored.is_array()) return stored;
  return stored.empty() ? json::array() : json::array({stored});
}

// Throws WeightsError.
Calibration Checked(const json& stored, const std::string& tensors, const std::string& path) {
  Calibration calibration;
  std::string made_for;
  try {
    calibration = From(stored);
    made_for = stored.value("tensors", made_for);
  } catch (const std::exception& error) {
    throw WeightsError(path + ": its calibration is damaged (" + error.what() + ")");
  }
  if (!made_for.empty() && made_for != tensors) {
    throw WeightsError(path +
                       ": its calibration was made for other weights, so no promise of it holds: "
                       "make one with ./prospect evaluate calibrate");
  }
  return calibration;
}

// What pictures are known (model/novelty.h) is measured on the networks, as the sample is: either
// may be stored first.
constexpr char kNoveltyPrefix[] = "novelty.";

}  // namespace

std::uint64_t TensorsHash(const WeightsFile& file) {
  std::uint64_t hash = base::HashText("tensors");
  for (const auto& [name, tensor] : file.tensors) {
    if (name.starts_with(kNoveltyPrefix)) continue;
    hash = base::HashText(name, hash);
    for (const std::int64_t extent : tensor.shape)
      hash = base::HashBytes(&extent, sizeof extent, hash);
    const bool half = tensor.type == StoredTensor::Type::kHalf;
    hash = base::HashText(half ? tensor.bytes : HalfTensor(tensor.shape, ToFloats(tensor)).bytes,
                          hash);
  }
  return hash;
}

void StoreCalibration(const std::string& weights_path, const Calibration& calibration) {
  WeightsFile file = ReadWeights(weights_path);
  const std::uint64_t tensors = TensorsHash(file);
  const json fresh = ToJson(calibration, tensors);
  json kept = json::array();
  bool stored = false;
  for (const json& earlier : ListIn(file.metadata)) {
    const CalibrationSample sample = SampleOrNone(earlier, base::HexText(tensors));
    if (sample.empty()) continue;
    const bool same = KindOf(sample) == KindOf(calibration.sample);
    if (!same || !stored) kept.push_back(same ? fresh : earlier);
    stored = stored || same;
  }
  if (!stored) kept.push_back(fresh);
  file.metadata["calibration"] = kept.size() == 1 ? kept.front() : kept;
  WriteWeights(weights_path, file.tensors, file.metadata);
}

std::vector<Calibration> CalibrationsOf(const WeightsFile& file, const std::string& path) {
  std::vector<Calibration> calibrations;
  const json list = ListIn(file.metadata);
  if (list.empty()) return calibrations;
  const std::string tensors = base::HexText(TensorsHash(file));
  for (const json& stored : list) calibrations.push_back(Checked(stored, tensors, path));
  return calibrations;
}

std::vector<Calibration> CalibrationsOf(const std::string& path) {
  return CalibrationsOf(ReadWeights(path), path);
}

std::vector<CalibrationSample> SamplesOf(const std::vector<Calibration>& calibrations) {
  std::vector<CalibrationSample> samples;
  for (const Calibration& calibration : calibrations) {
    if (!calibration.sample.empty()) samples.push_back(calibration.sample);
  }
  return samples;
}

}  // namespace prospect::model
