#include "model/turning_engine.h"

#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>

#include "base/random.h"
#include "model/turns.h"

namespace prospect::model {
namespace {

constexpr int kChannels = 3;

// Quarter turns to the left, the last four of a mirrored picture; turn 0 is the picture itself.
std::vector<std::uint8_t> Turned(Pixels picture, int side, int turn) {
  std::vector<std::uint8_t> turned(picture.size());
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      int from_x = turn < kMostTurns / 2 ? x : side - 1 - x;
      int from_y = y;
      for (int quarter = 0; quarter < turn % 4; ++quarter) {
        const int old_x = from_x;
        from_x = side - 1 - from_y;
        from_y = old_x;
      }
      const auto to = kChannels * (static_cast<std::size_t>(y) * side + x);
      const auto from = kChannels * (static_cast<std::size_t>(from_y) * side + from_x);
      for (int channel = 0; channel < kChannels; ++channel)
        turned[to + channel] = picture[from + channel];
    }
  }
  return turned;
}

void Add(const std::vector<float>& more, float share, std::vector<float>* sum) {
  sum->resize(more.size(), 0.f);
  for (std::size_t i = 0; i < more.size(); ++i) (*sum)[i] += share * more[i];
}

// Adds the answer for one of `turns` turns.
void Add(const Prediction& answer, int turns, Prediction* mean) {
  const float share = 1.f / static_cast<float>(turns);
  mean->h.insert(mean->h.end(), answer.h.begin(), answer.h.end());
  mean->value += share * answer.value;
  mean->done += share * answer.done;
  Add(answer.q, share, &mean->q);
  Add(answer.p, share, &mean->p);
}

}  // namespace

TurningEngine::TurningEngine(std::unique_ptr<Engine> inner, int turns)
    : EngineDecorator(std::move(inner)),
      turns_(turns),
      size_(EngineDecorator::info().hidden_size),
      info_(EngineDecorator::info()) {
  if (turns < 2 || turns > kMostTurns) throw std::invalid_argument("turns must be 2 to 8");
  if (info_.image_width != info_.image_height)
    throw std::invalid_argument("only square pictures can be turned");
  info_.hidden_size = size_ * turns_;
  info_.turns = turns_;
  info_.engine += ", mean of " + std::to_string(turns_) + " turns";
}

std::uint64_t TurningEngine::fingerprint() const {
  return base::MixSeeds({EngineDecorator::fingerprint(), static_cast<std::uint64_t>(turns_)});
}

std::span<const float> TurningEngine::Part(std::span<const float> state, int turn) const {
  return state.subspan(static_cast<std::size_t>(turn) * size_, size_);
}

std::vector<Hidden> TurningEngine::First(const std::vector<Hidden>& states) const {
  std::vector<Hidden> first;
  for (const Hidden& state : states) first.emplace_back(state.begin(), state.begin() + size_);
  return first;
}

Hidden TurningEngine::DoEncode(Pixels picture) {
  Hidden state;
  for (int turn = 0; turn < turns_; ++turn) {
    const Hidden part = inner().Encode(Turned(picture, info_.image_width, turn));
    state.insert(state.end(), part.begin(), part.end());
  }
  return state;
}

Prediction TurningEngine::DoEvaluate(std::span<const float> h0, std::span<const float> h,
                                     int previous_action) {
  Prediction mean;
  for (int turn = 0; turn < turns_; ++turn)
    Add(inner().Evaluate(Part(h0, turn), Part(h, turn), previous_action), turns_, &mean);
  mean.done = 1;
  return mean;
}

std::vector<Prediction> TurningEngine::DoExpand(const std::vector<ExpandInput>& rows) {
  std::vector<ExpandInput> parts;
  for (const ExpandInput& row : rows) {
    for (int turn = 0; turn < turns_; ++turn)
      parts.push_back({Part(row.h0, turn), Part(row.h, turn), row.action});
  }
  const std::vector<Prediction> answers = inner().Expand(parts);
  std::vector<Prediction> means(rows.size());
  for (std::size_t i = 0; i < answers.size(); ++i) Add(answers[i], turns_, &means[i / turns_]);
  return means;
}

std::vector<std::vector<std::uint8_t>> TurningEngine::DoDecode(const std::vector<Hidden>& states) {
  return inner().Decode(First(states));
}

std::vector<std::vector<std::uint8_t>> TurningEngine::DoDecodeOnto(
    Pixels seen, std::span<const float> start, const std::vector<Hidden>& states) {
  return inner().DecodeOnto(seen, Part(start, 0), First(states));
}

}  // namespace prospect::model
