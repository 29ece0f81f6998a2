#include "services/model/scripted_tree_engine.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "base/hash.h"

namespace prospect::services {
namespace {

using planner::Path;
using planner::ScriptedTree;

// The state: the seed in four parts of 16 bits (exact in floats), the path's length, its actions.
constexpr int kSeedParts = 4;
constexpr int kLengthAt = kSeedParts;
constexpr int kHiddenSize = kSeedParts + 1 + ScriptedTree::kDepth;

struct State {
  std::uint64_t seed = 0;
  Path path;
};

model::Hidden Pack(const State& state) {
  model::Hidden h(kHiddenSize, 0.0F);
  for (int i = 0; i < kSeedParts; ++i) h[i] = static_cast<float>(state.seed >> 16 * i & 0xffff);
  h[kLengthAt] = static_cast<float>(state.path.size());
  std::copy(state.path.begin(), state.path.end(), h.begin() + kLengthAt + 1);
  return h;
}

State Unpack(std::span<const float> h) {
  const float length = h[kLengthAt];
  if (!(length >= 0 && length <= ScriptedTree::kDepth) || length != std::floor(length))
    throw std::invalid_argument("this state is not a path of the scripted tree");
  State state;
  for (int i = 0; i < kSeedParts; ++i) state.seed |= static_cast<std::uint64_t>(h[i]) << 16 * i;
  for (int i = 0; i < static_cast<int>(length); ++i)
    state.path.push_back(static_cast<std::uint8_t>(h[kLengthAt + 1 + i]));
  return state;
}

model::Prediction Answer(const State& state) {
  planner::Evaluation evaluation = ScriptedTree{state.seed}.Evaluate(state.path);
  model::Prediction answer;
  answer.value = evaluation.value;
  answer.done = evaluation.done;
  answer.q = std::move(evaluation.q);
  answer.p = std::move(evaluation.p);
  return answer;
}

}  // namespace

ScriptedTreeEngine::ScriptedTreeEngine() {
  info_.engine = kTask;
  info_.task = kTask;
  info_.num_actions = ScriptedTree::kBranching;
  info_.image_width = info_.image_height = kImageSize;
  info_.hidden_size = kHiddenSize;
}

std::vector<std::uint8_t> ScriptedTreeEngine::PictureOf(std::uint64_t seed) {
  std::vector<std::uint8_t> picture(kImageSize * kImageSize * 3, 0);
  for (std::size_t i = 0; i < sizeof seed; ++i)
    picture[i] = static_cast<std::uint8_t>(seed >> 8 * i);
  return picture;
}

std::uint64_t ScriptedTreeEngine::weights_hash() const { return base::HashText(kTask); }

model::Hidden ScriptedTreeEngine::DoEncode(model::Pixels picture) {
  State root;
  for (std::size_t i = 0; i < sizeof root.seed; ++i)
    root.seed |= static_cast<std::uint64_t>(picture[i]) << 8 * i;
  return Pack(root);
}

model::Prediction ScriptedTreeEngine::DoEvaluate(std::span<const float>, std::span<const float> h,
                                                 int) {
  return Answer(Unpack(h));
}

std::vector<model::Prediction> ScriptedTreeEngine::DoExpand(
    const std::vector<model::ExpandInput>& rows) {
  std::vector<model::Prediction> answers;
  for (const auto& row : rows) {
    State state = Unpack(row.h);
    if (state.path.size() >= ScriptedTree::kDepth)
      throw std::invalid_argument("Expand: the plan is complete");
    state.path.push_back(static_cast<std::uint8_t>(row.action));
    answers.push_back(Answer(state));
    answers.back().h = Pack(state);
  }
  return answers;
}

std::vector<std::vector<std::uint8_t>> ScriptedTreeEngine::DoDecode(
    const std::vector<model::Hidden>& states) {
  std::vector<std::vector<std::uint8_t>> pictures;
  for (const auto& h : states) {
    const std::uint64_t colour = planner::HashPath(Unpack(h).path);
    std::vector<std::uint8_t> picture(kImageSize * kImageSize * 3);
    for (std::size_t i = 0; i < picture.size(); ++i)
      picture[i] = static_cast<std::uint8_t>(colour >> (i % 3 * 8));
    pictures.push_back(std::move(picture));
  }
  return pictures;
}

std::vector<float> ScriptedTreeEngine::DoClassify(model::Pixels) { return {}; }

}  // namespace prospect::services
