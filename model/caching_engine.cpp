#include "model/caching_engine.h"

#include <stdexcept>
#include <utility>

namespace prospect::model {
namespace {

enum Question : std::uint64_t { kEncode = 1, kEvaluate, kExpand };

std::size_t BytesOf(const Prediction& answer) {
  const std::size_t floats = answer.h.size() + answer.q.size() + answer.p.size();
  return sizeof(Prediction) + 96 + floats * sizeof(float);  // 96: list node and index entry
}

}  // namespace

CachingEngine::CachingEngine(std::unique_ptr<Engine> inner, std::size_t bytes)
    : EngineDecorator(std::move(inner)), budget_(bytes) {}

const Prediction* CachingEngine::Find(const QuestionKey& key) {
  const auto found = index_.find(key);
  if (found == index_.end()) return nullptr;
  entries_.splice(entries_.begin(), entries_, found->second);
  return &found->second->answer;
}

void CachingEngine::Keep(const QuestionKey& key, const Prediction& answer) {
  if (index_.count(key)) return;
  entries_.push_front({key, answer});
  index_[key] = entries_.begin();
  bytes_ += BytesOf(answer);
  while (bytes_ > budget_) {
    bytes_ -= BytesOf(entries_.back().answer);
    index_.erase(entries_.back().key);
    entries_.pop_back();
  }
}

QuestionKey CachingEngine::StateKey(const float* state) const {
  return KeyOf(state, static_cast<std::size_t>(info().hidden_size) * sizeof(float));
}

Hidden CachingEngine::Encode(const std::uint8_t* rgb) {
  if (rgb == nullptr) return inner().Encode(rgb);  // the inner engine says what is wrong
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto pixels = static_cast<std::size_t>(info().image_width * info().image_height);
  const QuestionKey key = Join(KeyOf(rgb, pixels * 3), kEncode);
  if (const Prediction* known = Find(key)) return ++hits_, known->h;
  ++misses_;
  Prediction answer;
  answer.h = inner().Encode(rgb);
  Keep(key, answer);
  return answer.h;
}

Prediction CachingEngine::Evaluate(const float* h0, const float* h, int previous_action) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const QuestionKey states = Join(StateKey(h0), StateKey(h));
  const QuestionKey key =
      Join(Join(states, static_cast<std::uint64_t>(previous_action)), kEvaluate);
  if (const Prediction* known = Find(key)) return ++hits_, *known;
  ++misses_;
  Prediction answer = inner().Evaluate(h0, h, previous_action);
  Keep(key, answer);
  return answer;
}

// h0 is the same for all rows of a search, so its bytes are read once.
std::vector<QuestionKey> CachingEngine::RowKeys(const std::vector<ExpandInput>& rows) const {
  std::vector<QuestionKey> keys;
  const float* first = nullptr;
  QuestionKey first_key;
  for (const ExpandInput& row : rows) {
    if (row.h0 != first) first = row.h0, first_key = StateKey(row.h0);
    const QuestionKey states = Join(first_key, StateKey(row.h));
    keys.push_back(Join(Join(states, static_cast<std::uint64_t>(row.action)), kExpand));
  }
  return keys;
}

std::vector<Prediction> CachingEngine::Expand(const std::vector<ExpandInput>& rows) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto keys = RowKeys(rows);
  std::vector<Prediction> answers(rows.size());
  std::vector<ExpandInput> asked;
  std::vector<std::size_t> place(rows.size());  // of the row's answer among the asked
  std::unordered_map<QuestionKey, std::size_t, QuestionKeyHash> places;
  std::vector<bool> known(rows.size(), false);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (const Prediction* answer = Find(keys[i])) {
      answers[i] = *answer;
      known[i] = true;
      continue;
    }
    const auto [entry, fresh] = places.emplace(keys[i], asked.size());
    if (fresh) asked.push_back(rows[i]);
    place[i] = entry->second;
  }
  const auto computed = inner().Expand(asked);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (known[i]) continue;
    answers[i] = computed.at(place[i]);
    Keep(keys[i], answers[i]);
  }
  misses_ += static_cast<std::int64_t>(asked.size());
  hits_ += static_cast<std::int64_t>(rows.size() - asked.size());
  return answers;
}

std::int64_t CachingEngine::hits() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return hits_;
}

std::int64_t CachingEngine::misses() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return misses_;
}

std::size_t CachingEngine::bytes() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return bytes_;
}

}  // namespace prospect::model
