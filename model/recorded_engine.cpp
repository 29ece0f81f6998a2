#include "model/recorded_engine.h"

#include <cstddef>
#include <nlohmann/json.hpp>
#include <span>
#include <stdexcept>
#include <utility>

#include "base/hash.h"

namespace prospect::model {
namespace {

using nlohmann::json;

constexpr char kMagic[] = "prospect engine recording 1\n";
// No state, picture or action table comes near it; a larger count means a damaged file.
constexpr std::uint32_t kMostNumbers = 1 << 26;

// --- keys

QuestionKey PictureKey(Pixels picture, const char* question) {
  return Join(KeyOf(std::as_bytes(picture)), base::HashText(question));
}

QuestionKey ActionKey(std::span<const float> h0, std::span<const float> h, int action,
                      const char* question) {
  const QuestionKey states = Join(KeyOf(std::as_bytes(h0)), KeyOf(std::as_bytes(h)));
  return Join(Join(states, static_cast<std::uint64_t>(action)), base::HashText(question));
}

QuestionKey DecodeKey(const Hidden& state) {
  return Join(KeyOf(std::as_bytes(std::span(state))), base::HashText("Decode"));
}

// --- the file: plain numbers in this machine's byte order

template <class T>
void Put(std::ostream& out, const T& number) {
  out.write(reinterpret_cast<const char*>(&number), sizeof number);
}

template <class T>
void PutAll(std::ostream& out, const std::vector<T>& numbers) {
  Put(out, static_cast<std::uint32_t>(numbers.size()));
  out.write(reinterpret_cast<const char*>(numbers.data()),
            static_cast<std::streamsize>(numbers.size() * sizeof(T)));
}

template <class T>
bool Get(std::istream& in, T* number) {
  return static_cast<bool>(in.read(reinterpret_cast<char*>(number), sizeof *number));
}

template <class T>
bool GetAll(std::istream& in, std::vector<T>* numbers) {
  std::uint32_t count = 0;
  if (!Get(in, &count) || count > kMostNumbers) return false;
  numbers->resize(count);
  return static_cast<bool>(in.read(reinterpret_cast<char*>(numbers->data()),
                                   static_cast<std::streamsize>(count * sizeof(T))));
}

bool GetAnswer(std::istream& in, QuestionKey* key, RecordedAnswer* answer) {
  Prediction& prediction = answer->prediction;
  return Get(in, &key->low) && Get(in, &key->high) && Get(in, &prediction.value) &&
         Get(in, &prediction.done) && GetAll(in, &prediction.h) && GetAll(in, &prediction.q) &&
         GetAll(in, &prediction.p) && GetAll(in, &answer->picture);
}

json HeadOf(const Engine& engine) {
  const EngineInfo& info = engine.info();
  return {{"engine", info.engine},
          {"task", info.task},
          {"task_hash", info.task_hash},
          {"num_actions", info.num_actions},
          {"image_width", info.image_width},
          {"image_height", info.image_height},
          {"hidden_size", info.hidden_size},
          {"turns", info.turns},
          {"refusal_threshold", info.refusal_threshold},
          {"weights_hash", engine.weights_hash()},
          {"fingerprint", engine.fingerprint()}};
}

EngineInfo InfoOf(const json& head) {
  EngineInfo info;
  info.engine = head.at("engine");
  info.task = head.at("task");
  info.task_hash = head.at("task_hash");
  info.num_actions = head.at("num_actions");
  info.image_width = head.at("image_width");
  info.image_height = head.at("image_height");
  info.hidden_size = head.at("hidden_size");
  info.turns = head.value("turns", 1);
  info.refusal_threshold = head.at("refusal_threshold");
  return info;
}

}  // namespace

// --- recording

RecordingEngine::RecordingEngine(std::unique_ptr<Engine> inner, const std::string& path)
    : EngineDecorator(std::move(inner)), path_(path), file_(path, std::ios::binary) {
  file_ << kMagic;
  const std::string head = HeadOf(this->inner()).dump();
  PutAll(file_, std::vector<char>(head.begin(), head.end()));
  Flush();
}

void RecordingEngine::Flush() {
  if (!file_.flush()) {
    throw std::runtime_error("cannot write the engine's recording " + path_ +
                             ": is the folder there, and the disk full?");
  }
}

void RecordingEngine::Write(const QuestionKey& key, const RecordedAnswer& answer) {
  if (!written_.insert(key).second) return;
  Put(file_, key.low);
  Put(file_, key.high);
  Put(file_, answer.prediction.value);
  Put(file_, answer.prediction.done);
  PutAll(file_, answer.prediction.h);
  PutAll(file_, answer.prediction.q);
  PutAll(file_, answer.prediction.p);
  PutAll(file_, answer.picture);
}

Hidden RecordingEngine::DoEncode(Pixels picture) {
  const std::lock_guard<std::mutex> lock(mutex_);
  RecordedAnswer answer;
  answer.prediction.h = inner().Encode(picture);
  Write(PictureKey(picture, "Encode"), answer);
  Flush();
  return answer.prediction.h;
}

Prediction RecordingEngine::DoEvaluate(std::span<const float> h0, std::span<const float> h,
                                       int previous_action) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const RecordedAnswer answer{inner().Evaluate(h0, h, previous_action), {}};
  Write(ActionKey(h0, h, previous_action, "Evaluate"), answer);
  Flush();
  return answer.prediction;
}

std::vector<Prediction> RecordingEngine::DoExpand(const std::vector<ExpandInput>& rows) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto answers = inner().Expand(rows);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    Write(ActionKey(rows[i].h0, rows[i].h, rows[i].action, "Expand"), {answers[i], {}});
  }
  Flush();
  return answers;
}

std::vector<std::vector<std::uint8_t>> RecordingEngine::DoDecode(
    const std::vector<Hidden>& states) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto pictures = inner().Decode(states);
  for (std::size_t i = 0; i < states.size(); ++i) Write(DecodeKey(states[i]), {{}, pictures[i]});
  Flush();
  return pictures;
}

std::vector<float> RecordingEngine::DoClassify(Pixels picture) {
  const std::lock_guard<std::mutex> lock(mutex_);
  RecordedAnswer answer;
  answer.prediction.p = inner().Classify(picture);
  Write(PictureKey(picture, "Classify"), answer);
  Flush();
  return answer.prediction.p;
}

// --- replay

ReplayEngine::ReplayEngine(const std::string& path) : path_(path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("cannot read the engine's recording " + path);
  ReadHead(file);
  QuestionKey key;
  for (RecordedAnswer answer; GetAnswer(file, &key, &answer);) answers_[key] = answer;
}

void ReplayEngine::ReadHead(std::istream& file) {
  std::string magic(sizeof kMagic - 1, '\0');
  std::vector<char> head;
  if (!file.read(magic.data(), sizeof kMagic - 1) || magic != kMagic || !GetAll(file, &head))
    throw std::runtime_error(path_ + " is no recording of an engine");
  try {
    const json fields = json::parse(head.begin(), head.end());
    info_ = InfoOf(fields);
    weights_hash_ = fields.at("weights_hash");
    fingerprint_ = fields.at("fingerprint");
  } catch (const json::exception&) {  // its words may quote bytes that are no text
    throw std::runtime_error(path_ + ": its head is damaged");
  }
}

const RecordedAnswer& ReplayEngine::Find(const QuestionKey& key, const char* question) const {
  const auto found = answers_.find(key);
  if (found == answers_.end()) {
    throw std::runtime_error(path_ + " holds no answer to this " + question +
                             ": it was recorded with other pictures, actions or weights");
  }
  return found->second;
}

Hidden ReplayEngine::DoEncode(Pixels picture) {
  return Find(PictureKey(picture, "Encode"), "Encode").prediction.h;
}

Prediction ReplayEngine::DoEvaluate(std::span<const float> h0, std::span<const float> h,
                                    int previous_action) {
  return Find(ActionKey(h0, h, previous_action, "Evaluate"), "Evaluate").prediction;
}

std::vector<Prediction> ReplayEngine::DoExpand(const std::vector<ExpandInput>& rows) {
  std::vector<Prediction> answers;
  for (const ExpandInput& row : rows) {
    const auto key = ActionKey(row.h0, row.h, row.action, "Expand");
    answers.push_back(Find(key, "Expand").prediction);
  }
  return answers;
}

std::vector<std::vector<std::uint8_t>> ReplayEngine::DoDecode(const std::vector<Hidden>& states) {
  std::vector<std::vector<std::uint8_t>> pictures;
  for (const Hidden& state : states) pictures.push_back(Find(DecodeKey(state), "Decode").picture);
  return pictures;
}

std::vector<float> ReplayEngine::DoClassify(Pixels picture) {
  return Find(PictureKey(picture, "Classify"), "Classify").prediction.p;
}

}  // namespace prospect::model
