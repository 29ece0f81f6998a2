#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "model/engine.h"

namespace prospect::model {

/// An engine that stands around another and passes every call on: those that change one thing
/// about an engine (its time, its memory, what is written down) derive from it and override only
/// that. Owns the inner engine. As thread-safe as the inner one.
class EngineDecorator : public Engine {
 public:
  explicit EngineDecorator(std::unique_ptr<Engine> inner) : inner_(std::move(inner)) {}

  const EngineInfo& info() const override { return inner_->info(); }
  std::uint64_t weights_hash() const override { return inner_->weights_hash(); }
  std::uint64_t fingerprint() const override { return inner_->fingerprint(); }

 protected:
  Hidden DoEncode(Pixels picture) override { return inner_->Encode(picture); }
  Prediction DoEvaluate(std::span<const float> h0, std::span<const float> h,
                        int previous_action) override {
    return inner_->Evaluate(h0, h, previous_action);
  }
  std::vector<Prediction> DoExpand(const std::vector<ExpandInput>& rows) override {
    return inner_->Expand(rows);
  }
  std::vector<std::vector<std::uint8_t>> DoDecode(const std::vector<Hidden>& states) override {
    return inner_->Decode(states);
  }
  std::vector<std::vector<std::uint8_t>> DoDecodeOnto(Pixels seen, std::span<const float> start,
                                                      const std::vector<Hidden>& states) override {
    return inner_->DecodeOnto(seen, start, states);
  }
  std::vector<float> DoClassify(Pixels picture) override { return inner_->Classify(picture); }
  Engine& inner() { return *inner_; }
  const Engine& inner() const { return *inner_; }

 private:
  std::unique_ptr<Engine> inner_;
};

}  // namespace prospect::model
