#include "model/engine_facts.h"

#include <vector>

#include "base/hash.h"
#include "model/calibration.h"

namespace prospect::model {

EngineInfo InfoOf(const WeightsFile& file, const std::string& path, const NetworkConfig& config,
                  const std::string& engine, bool judges) {
  const std::vector<Calibration> calibrations = CalibrationsOf(file, path);
  EngineInfo info;
  info.judges = judges;
  info.engine = engine;
  info.task = file.metadata.value("task", "");
  info.task_hash = file.metadata.value("task_hash", "");
  info.num_actions = config.num_actions;
  info.image_width = config.image_width;
  info.image_height = config.image_height;
  info.hidden_size = config.hidden_size();
  if (!calibrations.empty()) info.refusal_threshold = calibrations.front().refusal_threshold;
  info.calibrations = SamplesOf(calibrations);
  return info;
}

std::uint64_t HashOfProbe(Engine& engine) {
  const EngineInfo& info = engine.info();
  std::vector<std::uint8_t> picture(static_cast<std::size_t>(info.image_width) * info.image_height *
                                    3);
  for (std::size_t i = 0; i < picture.size(); ++i)
    picture[i] = static_cast<std::uint8_t>(i * 7 / 64);
  const Hidden h0 = engine.Encode(picture);
  const Prediction answer = engine.Expand({{h0, h0, 0}}).front();
  std::uint64_t hash = base::HashBytes(answer.h.data(), answer.h.size() * sizeof(float));
  hash = base::HashBytes(&answer.value, sizeof(float), hash);
  hash = base::HashBytes(&answer.done, sizeof(float), hash);
  hash = base::HashBytes(answer.q.data(), answer.q.size() * sizeof(float), hash);
  return base::HashBytes(answer.p.data(), answer.p.size() * sizeof(float), hash);
}

}  // namespace prospect::model
