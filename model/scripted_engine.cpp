#include "model/scripted_engine.h"

#include <cstddef>
#include <span>

#include "base/hash.h"

namespace prospect::model {
namespace {

constexpr int kHiddenSize = 4;  // a 64-bit state as four 16-bit numbers, exact in floats
constexpr std::uint64_t kRootState = 0x5ce1;

Hidden Pack(std::uint64_t state) {
  Hidden h(kHiddenSize);
  for (float& part : h) {
    part = static_cast<float>(state & 0xffff);
    state >>= 16;
  }
  return h;
}

std::uint64_t Unpack(std::span<const float> h) {
  std::uint64_t state = 0;
  for (int i = kHiddenSize - 1; i >= 0; --i)
    state = state << 16 | static_cast<std::uint64_t>(h[static_cast<std::size_t>(i)]);
  return state;
}

/// Uniform in [0,1), a pure function of (state, question).
float Draw(std::uint64_t state, std::uint64_t question) {
  return static_cast<float>(base::Mix64(state ^ base::Mix64(question)) >> 40) * 0x1.0p-24F;
}

}  // namespace

ScriptedEngine::ScriptedEngine(const ScriptedOptions& options) : options_(options) {
  info_.engine = "scripted";
  info_.task = options.task;
  info_.num_actions = options.num_actions;
  info_.image_width = options.image_width;
  info_.image_height = options.image_height;
  info_.hidden_size = kHiddenSize;
  info_.refusal_threshold = options.refusal_threshold;
  info_.calibrations = options.calibrations;
}

Hidden ScriptedEngine::DoEncode(Pixels) { return Pack(base::Mix64(kRootState ^ options_.seed)); }

Prediction ScriptedEngine::Answer(std::uint64_t state, int action, float done) const {
  Prediction answer;
  answer.done = done;
  answer.value = 0.3F + 0.7F * Draw(state, 1);
  for (int a = 0; a < options_.num_actions; ++a) {
    const bool offered = a < options_.offered_actions && a != action;
    answer.q.push_back(0.1F + 0.9F * Draw(state, 100 + static_cast<std::uint64_t>(a)));
    answer.p.push_back(offered ? 0.95F : 0.001F);
  }
  return answer;
}

Prediction ScriptedEngine::DoEvaluate(std::span<const float>, std::span<const float> h,
                                      int previous_action) {
  return Answer(Unpack(h), previous_action, 1.0F);
}

std::vector<Prediction> ScriptedEngine::DoExpand(const std::vector<ExpandInput>& rows) {
  std::vector<Prediction> answers;
  for (const ExpandInput& row : rows) {
    const std::uint64_t state =
        base::Mix64(Unpack(row.h) * 31 + static_cast<std::uint64_t>(row.action) + 1);
    const bool fails = Draw(state, 2) < static_cast<float>(options_.failing_share);
    answers.push_back(Answer(state, row.action, fails ? 0.02F : 0.8F + 0.2F * Draw(state, 3)));
    answers.back().h = Pack(state);
  }
  return answers;
}

std::vector<std::vector<std::uint8_t>> ScriptedEngine::DoDecode(const std::vector<Hidden>& states) {
  std::vector<std::vector<std::uint8_t>> pictures;
  const auto pixels = static_cast<std::size_t>(options_.image_width * options_.image_height);
  for (const Hidden& h : states) {
    const std::uint64_t state = Unpack(h);
    std::vector<std::uint8_t> picture;
    for (std::size_t i = 0; i < pixels * 3; ++i) {
      picture.push_back(static_cast<std::uint8_t>(state >> (i % 3 * 8)));
    }
    pictures.push_back(std::move(picture));
  }
  return pictures;
}

std::vector<float> ScriptedEngine::DoClassify(Pixels) {
  return std::vector<float>(static_cast<std::size_t>(options_.num_actions),
                            1.0F / static_cast<float>(options_.num_actions));
}

std::uint64_t ScriptedEngine::weights_hash() const {
  return base::HashText("scripted/" + options_.task + "/" + std::to_string(options_.num_actions) +
                        "/" + std::to_string(options_.offered_actions) + "/" +
                        std::to_string(options_.failing_share) + "/" +
                        std::to_string(options_.seed));
}

std::uint64_t ScriptedEngine::fingerprint() const { return base::Mix64(weights_hash()); }

}  // namespace prospect::model
