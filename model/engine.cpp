#include "model/engine.h"

#include <cstddef>
#include <stdexcept>

namespace prospect::model {
namespace {

/// "Expand: a state of 3 numbers, where 192 are expected".
void RequireSize(const char* call, const char* what, std::size_t given, const char* unit,
                 std::size_t expected) {
  if (given == expected) return;
  throw std::invalid_argument(std::string(call) + ": " + what + " of " + std::to_string(given) +
                              " " + unit + ", where " + std::to_string(expected) + " are expected");
}

void RequirePicture(const char* call, Pixels picture, const EngineInfo& info) {
  const auto pixels =
      static_cast<std::size_t>(info.image_width) * static_cast<std::size_t>(info.image_height);
  RequireSize(call, "a picture", picture.size(), "bytes", pixels * 3);
}

void RequireState(const char* call, std::span<const float> state, const EngineInfo& info) {
  RequireSize(call, "a state", state.size(), "numbers", static_cast<std::size_t>(info.hidden_size));
}

void RequireStates(const char* call, const std::vector<Hidden>& states, const EngineInfo& info) {
  for (const Hidden& state : states) RequireState(call, state, info);
}

void RequireAction(const char* call, int action, int last) {
  if (action >= 0 && action <= last) return;
  throw std::invalid_argument(std::string(call) + ": action " + std::to_string(action) +
                              ", where 0 to " + std::to_string(last) + " are expected");
}

}  // namespace

Hidden Engine::Encode(Pixels picture) {
  RequirePicture("Encode", picture, info());
  return DoEncode(picture);
}

Prediction Engine::Evaluate(std::span<const float> h0, std::span<const float> h,
                            int previous_action) {
  RequireState("Evaluate", h0, info());
  RequireState("Evaluate", h, info());
  RequireAction("Evaluate", previous_action, info().num_actions);
  return DoEvaluate(h0, h, previous_action);
}

std::vector<Prediction> Engine::Expand(const std::vector<ExpandInput>& rows) {
  for (const ExpandInput& row : rows) {
    RequireState("Expand", row.h0, info());
    RequireState("Expand", row.h, info());
    RequireAction("Expand", row.action, info().num_actions - 1);
  }
  return DoExpand(rows);
}

std::vector<std::vector<std::uint8_t>> Engine::Decode(const std::vector<Hidden>& states) {
  RequireStates("Decode", states, info());
  return DoDecode(states);
}

std::vector<std::vector<std::uint8_t>> Engine::DecodeOnto(Pixels seen, std::span<const float> start,
                                                          const std::vector<Hidden>& states) {
  RequirePicture("DecodeOnto", seen, info());
  RequireState("DecodeOnto", start, info());
  RequireStates("DecodeOnto", states, info());
  return DoDecodeOnto(seen, start, states);
}

std::vector<float> Engine::Classify(Pixels picture) {
  RequirePicture("Classify", picture, info());
  return DoClassify(picture);
}

}  // namespace prospect::model
