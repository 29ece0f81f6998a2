#pragma once

#include <cstddef>
#include <cstdint>
#include <list>
#include <memory>
#include <mutex>
#include <unordered_map>
#include <vector>

#include "model/engine_decorator.h"
#include "model/question_key.h"

namespace prospect::model {

/// Remembers answers by what was asked (the states' contents, not where they lie), within a budget
/// of bytes, least recently used out first. Encode, Evaluate and Expand are remembered; equal rows
/// of one Expand are computed once. Because an engine's answers are pure functions of a row, a
/// remembered answer is bit for bit the one that would be computed. Thread-safe: one call at a
/// time.
class CachingEngine : public EngineDecorator {
 public:
  CachingEngine(std::unique_ptr<Engine> inner, std::size_t bytes);

  /// Rows answered from memory, and rows that the inner engine computed.
  std::int64_t hits() const;
  std::int64_t misses() const;
  /// Bytes held, at most the budget.
  std::size_t bytes() const;

 protected:
  Hidden DoEncode(Pixels picture) override;
  Prediction DoEvaluate(std::span<const float> h0, std::span<const float> h,
                        int previous_action) override;
  std::vector<Prediction> DoExpand(const std::vector<ExpandInput>& rows) override;

 private:
  struct Entry {
    QuestionKey key;
    Prediction answer;
  };

  const Prediction* Find(const QuestionKey& key);
  void Keep(const QuestionKey& key, const Prediction& answer);
  std::vector<QuestionKey> RowKeys(const std::vector<ExpandInput>& rows) const;

  const std::size_t budget_;
  mutable std::mutex mutex_;
  // All guarded by mutex_.
  std::list<Entry> entries_;  // most recently used first
  std::unordered_map<QuestionKey, std::list<Entry>::iterator, QuestionKeyHash> index_;
  std::size_t bytes_ = 0;
  std::int64_t hits_ = 0, misses_ = 0;
};

}  // namespace prospect::model
