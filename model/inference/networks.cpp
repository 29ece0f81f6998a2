#include "model/inference/networks.h"

namespace prospect::model::inference {

Networks::Networks(const Kernels& kernels, const WeightsFile& file, const std::string& path)
    : config_(NetworkConfigOf(file, path)),
      encoder_(kernels, {file, path}, config_),
      decoder_(kernels, {file, path}, config_),
      transform_(kernels, {file, path}, config_) {
  const TensorReader reader(file, path);
  if (HasModule(file, "value") || HasModule(file, "q")) {
    value_.emplace(kernels, reader, config_);
    q_.emplace(kernels, reader, "q", config_, config_.num_actions);
    p_.emplace(kernels, reader, "p", config_, config_.num_actions);
    f_.emplace(kernels, reader, "f", config_, 1);
  }
  if (HasModule(file, "classifier")) classifier_.emplace(kernels, reader, "classifier", config_);
}

void Networks::Encode(const std::uint8_t* rgb, float* h, Arena& arena) const {
  const Arena::Scope scope(arena);
  const auto size = static_cast<std::size_t>(config_.image_bytes());
  float* const picture = arena.Take(size);
  ToFloats(rgb, size, picture);
  float* const by_pixel = arena.Take(hidden_size());
  encoder_.Run(picture, by_pixel, arena);
  ToChannelMajor(by_pixel, config_.hidden_channels, hidden_pixels(), h);
}

void Networks::Decode(const float* h, float* picture, Arena& arena) const {
  const Arena::Scope scope(arena);
  float* const by_pixel = arena.Take(hidden_size());
  ToPixelMajor(h, config_.hidden_channels, hidden_pixels(), by_pixel);
  decoder_.Run(by_pixel, picture, arena);
}

std::vector<float> Networks::Classify(const std::uint8_t* rgb, Arena& arena) const {
  const Arena::Scope scope(arena);
  const auto size = static_cast<std::size_t>(config_.image_bytes());
  float* const picture = arena.Take(size);
  ToFloats(rgb, size, picture);
  return classifier_->Run(picture, arena);
}

RootPart Networks::FoldRoot(const float* h0, Arena& arena) const {
  const Arena::Scope scope(arena);
  float* const by_pixel = arena.Take(hidden_size());
  ToPixelMajor(h0, config_.hidden_channels, hidden_pixels(), by_pixel);
  RootPart root;
  const auto fold = [&](const auto& network, std::vector<float>* part) {
    part->resize(network.root_size());
    network.FoldRoot(by_pixel, part->data(), arena);
  };
  fold(transform_, &root.transform);
  if (!judges()) return root;
  fold(*q_, &root.q);
  fold(*p_, &root.p);
  fold(*f_, &root.f);
  return root;
}

void Networks::JudgeStates(std::span<const Question> questions, const float* states,
                           Judgements* judgements, Arena& arena) const {
  const Arena::Scope scope(arena);
  const int count = static_cast<int>(questions.size());
  auto* const rows = arena.Take<StateRow>(questions.size());
  const auto ask = [&](const ActionHead& head, std::vector<float> RootPart::*part,
                       std::vector<float>* answers) {
    for (std::size_t i = 0; i < questions.size(); ++i) {
      rows[i] = {states + i * hidden_size(), (questions[i].root->*part).data(),
                 questions[i].action};
    }
    answers->resize(questions.size() * static_cast<std::size_t>(head.outputs()));
    head.Run(rows, count, answers->data(), arena);
  };
  judgements->value.resize(questions.size());
  value_->Run(states, count, judgements->value.data(), arena);
  ask(*q_, &RootPart::q, &judgements->q);
  ask(*p_, &RootPart::p, &judgements->p);
  ask(*f_, &RootPart::f, &judgements->done);
}

void Networks::Judge(std::span<const Question> questions, Judgements* judgements,
                     Arena& arena) const {
  if (!judges()) return;
  const Arena::Scope scope(arena);
  float* const states = arena.Take(questions.size() * hidden_size());
  for (std::size_t i = 0; i < questions.size(); ++i) {
    ToPixelMajor(questions[i].h, config_.hidden_channels, hidden_pixels(),
                 states + i * hidden_size());
  }
  JudgeStates(questions, states, judgements, arena);
}

void Networks::Expand(std::span<const Question> questions, float* next, Judgements* judgements,
                      Arena& arena) const {
  const Arena::Scope scope(arena);
  const int channels = config_.hidden_channels;
  float* const before = arena.Take(questions.size() * hidden_size());
  float* const after = arena.Take(questions.size() * hidden_size());
  auto* const rows = arena.Take<StateRow>(questions.size());
  for (std::size_t i = 0; i < questions.size(); ++i) {
    float* const h = before + i * hidden_size();
    ToPixelMajor(questions[i].h, channels, hidden_pixels(), h);
    rows[i] = {h, questions[i].root->transform.data(), questions[i].action};
  }
  transform_.Run(rows, static_cast<int>(questions.size()), after, arena);
  for (std::size_t i = 0; i < questions.size(); ++i) {
    ToChannelMajor(after + i * hidden_size(), channels, hidden_pixels(), next + i * hidden_size());
  }
  if (judges()) JudgeStates(questions, after, judgements, arena);
}

}  // namespace prospect::model::inference
