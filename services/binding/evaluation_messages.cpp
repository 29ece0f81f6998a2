#include "services/binding/evaluation_messages.h"

namespace prospect::services {
namespace {

float OnGrid(float x) { return planner::Dequantize(planner::Quantize(x)); }
std::int16_t Bits(float x) { return static_cast<std::int16_t>(planner::Quantize(x)); }
float FromBits(std::int16_t bits) { return planner::Dequantize(static_cast<std::uint16_t>(bits)); }

}  // namespace

path_t ToMessage(const planner::Path& path) {
  path_t message{};
  message.num_actions = static_cast<std::int32_t>(path.size());
  message.actions = path;
  return message;
}

planner::Path FromMessage(const path_t& message) { return message.actions; }

std::vector<planner::Path> FromMessages(const std::vector<path_t>& messages) {
  std::vector<planner::Path> paths;
  for (const auto& message : messages) paths.push_back(message.actions);
  return paths;
}

evaluation_t ToMessage(const planner::Path& path, const planner::Evaluation& evaluation,
                       const std::vector<int>& allowed) {
  evaluation_t message{};
  message.path = ToMessage(path);
  message.value = OnGrid(evaluation.value);
  message.done = OnGrid(evaluation.done);
  message.num_allowed = static_cast<std::int32_t>(allowed.size());
  for (const int action : allowed) {
    const auto index = static_cast<std::size_t>(action);
    message.actions.push_back(static_cast<std::uint8_t>(action));
    message.q.push_back(Bits(evaluation.q.at(index)));
    message.p.push_back(Bits(evaluation.p.at(index)));
  }
  return message;
}

planner::Evaluation FromMessage(const evaluation_t& message, int num_actions) {
  planner::Evaluation evaluation;
  evaluation.value = message.value;
  evaluation.done = message.done;
  evaluation.q.assign(static_cast<std::size_t>(num_actions), 0.0f);
  evaluation.p.assign(static_cast<std::size_t>(num_actions), 0.0f);
  for (std::size_t i = 0; i < message.actions.size(); ++i) {
    if (message.actions[i] >= num_actions) continue;
    evaluation.q[message.actions[i]] = FromBits(message.q[i]);
    evaluation.p[message.actions[i]] = FromBits(message.p[i]);
  }
  return evaluation;
}

}  // namespace prospect::services
