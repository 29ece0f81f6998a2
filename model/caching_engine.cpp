#include "model/caching_engine.h"

#include <span>
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
  if (index_.contains(key)) return;
  entries_.push_front({key, answer});
  index_[key] = entries_.begin();
  bytes_ += BytesOf(answer);
  while (bytes_ > budget_) {
    bytes_ -= BytesOf(entries_.back().answer);
    index_.erase(entries_.back().key);
    entries_.pop_back();
  }
}

Hidden CachingEngine::DoEncode(Pixels picture) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const QuestionKey key = Join(KeyOf(std::as_bytes(picture)), kEncode);
  if (const Prediction* known = Find(key)) return ++hits_, known->h;
  ++misses_;
  Prediction answer;
  answer.h = inner().Encode(picture);
  Keep(key, answer);
  return answer.h;
}

Prediction CachingEngine::DoEvaluate(std::span<const float> h0, std::span<const float> h,
                                     int previous_action) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const QuestionKey states = Join(KeyOf(std::as_bytes(h0)), KeyOf(std::as_bytes(h)));
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
    if (row.h0.data() != first) first = row.h0.data(), first_key = KeyOf(std::as_bytes(row.h0));
    const QuestionKey states = Join(first_key, KeyOf(std::as_bytes(row.h)));
    keys.push_back(Join(Join(states, static_cast<std::uint64_t>(row.action)), kExpand));
  }
  return keys;
}

std::vector<Prediction> CachingEngine::DoExpand(const std::vector<ExpandInput>& rows) {
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
