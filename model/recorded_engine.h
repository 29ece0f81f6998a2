#pragma once

#include <cstdint>
#include <fstream>
#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "model/engine_decorator.h"
#include "model/question_key.h"

namespace prospect::model {

/// What an engine once answered: any kind of answer in one shape. Encode uses prediction.h,
/// Classify prediction.p, Decode picture.
struct RecordedAnswer {
  Prediction prediction;
  std::vector<std::uint8_t> picture;
};

/// Writes every question (as a key) with its answer to a file, each question once, and passes the
/// answer on. The file holds the engine's info, weights hash and fingerprint, too, so that
/// ReplayEngine can stand in for it. An answer is in the file when the call returns; a file cut off
/// by a crash replays up to its last whole answer. Thread-safe: one call at a time.
class RecordingEngine : public EngineDecorator {
 public:
  /// Throws std::runtime_error when the file cannot be written.
  RecordingEngine(std::unique_ptr<Engine> inner, const std::string& path);

 protected:
  Hidden DoEncode(Pixels picture) override;
  Prediction DoEvaluate(std::span<const float> h0, std::span<const float> h,
                        int previous_action) override;
  std::vector<Prediction> DoExpand(const std::vector<ExpandInput>& rows) override;
  std::vector<std::vector<std::uint8_t>> DoDecode(const std::vector<Hidden>& states) override;
  std::vector<float> DoClassify(Pixels picture) override;

 private:
  void Write(const QuestionKey& key, const RecordedAnswer& answer);
  void Flush();

  std::string path_;
  std::mutex mutex_;
  // Guarded by mutex_.
  std::ofstream file_;
  std::unordered_set<QuestionKey, QuestionKeyHash> written_;
};

/// Answers from a RecordingEngine's file, without the networks. Immutable after construction;
/// thread-safe. A question that was not recorded throws std::runtime_error saying so.
class ReplayEngine : public Engine {
 public:
  /// Throws std::runtime_error naming the file and what is wrong with it.
  explicit ReplayEngine(const std::string& path);

  const EngineInfo& info() const override { return info_; }
  std::uint64_t weights_hash() const override { return weights_hash_; }
  std::uint64_t fingerprint() const override { return fingerprint_; }

  /// Answers held.
  std::size_t size() const { return answers_.size(); }

 protected:
  Hidden DoEncode(Pixels picture) override;
  Prediction DoEvaluate(std::span<const float> h0, std::span<const float> h,
                        int previous_action) override;
  std::vector<Prediction> DoExpand(const std::vector<ExpandInput>& rows) override;
  std::vector<std::vector<std::uint8_t>> DoDecode(const std::vector<Hidden>& states) override;
  std::vector<float> DoClassify(Pixels picture) override;

 private:
  void ReadHead(std::istream& file);
  const RecordedAnswer& Find(const QuestionKey& key, const char* question) const;

  std::string path_;
  EngineInfo info_;
  std::uint64_t weights_hash_ = 0, fingerprint_ = 0;
  std::unordered_map<QuestionKey, RecordedAnswer, QuestionKeyHash> answers_;
};

}  // namespace prospect::model
