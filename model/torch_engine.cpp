#include <algorithm>
#include <cstring>
#include <mutex>
#include <nlohmann/json.hpp>
#include <span>

#include "base/hash.h"
#include "model/engine.h"
#include "model/engine_facts.h"
#include "model/networks/libtorch.h"
#include "model/networks/light.h"
#include "model/networks/networks.h"
#include "model/row_pool.h"
#include "model/weights.h"

namespace prospect::model {
namespace {

using nlohmann::json;

std::vector<float> ToVector(const torch::Tensor& tensor) {
  const torch::Tensor flat = tensor.contiguous();
  const float* data = flat.data_ptr<float>();
  return std::vector<float>(data, data + flat.numel());
}

/// Networks in 32-bit floats on the CPU; one row at a time, rows spread over threads.
class TorchEngine : public Engine {
 public:
  TorchEngine(const std::string& path, int threads)
      : TorchEngine(ReadWeights(path), path, threads) {}

  const EngineInfo& info() const override { return info_; }
  std::uint64_t weights_hash() const override { return weights_hash_; }
  std::uint64_t fingerprint() const override { return fingerprint_; }

 protected:
  Hidden DoEncode(Pixels picture) override {
    const std::lock_guard<std::mutex> lock(mutex_);
    const c10::InferenceMode inference;
    return ToVector(networks_.encoder->forward(Picture(picture)));
  }

  Prediction DoEvaluate(std::span<const float> h0, std::span<const float> h,
                        int previous_action) override {
    const std::lock_guard<std::mutex> lock(mutex_);
    const c10::InferenceMode inference;
    return Judge(State(h0), State(h), previous_action, /*imagined=*/false);
  }

  std::vector<Prediction> DoExpand(const std::vector<ExpandInput>& rows) override {
    const std::lock_guard<std::mutex> lock(mutex_);
    std::vector<Prediction> answers(rows.size());
    pool_.Run(rows.size(), [&](std::size_t i) {
      const c10::InferenceMode inference;
      answers[i] = Imagine(rows[i]);
    });
    return answers;
  }

  std::vector<std::vector<std::uint8_t>> DoDecode(const std::vector<Hidden>& states) override {
    return Paint(states, [](const torch::Tensor& decoded) { return decoded; });
  }

  std::vector<std::vector<std::uint8_t>> DoDecodeOnto(Pixels seen, std::span<const float> start,
                                                      const std::vector<Hidden>& states) override {
    torch::Tensor decoded_start;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      const c10::InferenceMode inference;
      decoded_start = networks_.decoder->forward(State(start));
    }
    const torch::Tensor picture = Picture(seen);
    return Paint(states, [&](const torch::Tensor& decoded) {
      return ImaginedPicture(picture, decoded_start, decoded, compose_);
    });
  }

  std::vector<float> DoClassify(Pixels picture) override {
    if (!networks_.has_classifier) return {};
    const std::lock_guard<std::mutex> lock(mutex_);
    const c10::InferenceMode inference;
    return ToVector(torch::softmax(networks_.classifier->forward(Picture(picture)), 1));
  }

 private:
  TorchEngine(const WeightsFile& file, const std::string& path, int threads)
      : networks_(NetworkConfigOf(file, path)),
        weights_hash_(file.hash),
        compose_(file.metadata.value("train", nlohmann::json::object()).value("compose", true)),
        pool_(std::max(1, threads), [] { at::set_num_threads(1); }) {
    at::set_num_threads(1);  // rows are the parallelism
    networks_.has_classifier = HasModule(file, "classifier");
    networks_.has_second_classifier = HasModule(file, "second_classifier");
    networks_.has_heads = HasModule(file, "value") || HasModule(file, "q");
    for (const auto& [prefix, module] : networks_.named()) {
      if (networks_.Has(prefix)) LoadModule(file, path, prefix, module);
    }
    networks_.SetTraining(false);
    // Last: what is wrong with the networks is the better message.
    info_ = InfoOf(file, path, networks_.config, "torch", networks_.has_heads);
    fingerprint_ = HashOfProbe(*this);
  }

  /// Decodes states, each finished by `finish`, into bytes.
  template <typename Finish>
  std::vector<std::vector<std::uint8_t>> Paint(const std::vector<Hidden>& states,
                                               const Finish& finish) {
    const std::lock_guard<std::mutex> lock(mutex_);
    std::vector<std::vector<std::uint8_t>> pictures(states.size());
    pool_.Run(states.size(), [&](std::size_t i) {
      const c10::InferenceMode inference;
      const torch::Tensor x = finish(networks_.decoder->forward(State(states[i])));
      const torch::Tensor bytes =
          x[0].permute({1, 2, 0}).mul(255.0F).round().clamp(0, 255).to(torch::kUInt8).contiguous();
      pictures[i].assign(bytes.data_ptr<std::uint8_t>(),
                         bytes.data_ptr<std::uint8_t>() + bytes.numel());
    });
    return pictures;
  }

  torch::Tensor Picture(Pixels picture) const {
    const torch::Tensor raw =
        torch::from_blob(const_cast<std::uint8_t*>(picture.data()),
                         {1, info_.image_height, info_.image_width, 3}, torch::kUInt8);
    return raw.permute({0, 3, 1, 2}).contiguous().to(torch::kFloat).div_(255.0F);
  }

  torch::Tensor State(std::span<const float> h) const {
    const NetworkConfig& c = networks_.config;
    return torch::from_blob(const_cast<float*>(h.data()),
                            {1, c.hidden_channels, c.hidden_height(), c.hidden_width()});
  }

  Prediction Imagine(const ExpandInput& row) {
    const torch::Tensor h0 = State(row.h0);
    const torch::Tensor action = torch::full({1}, row.action, torch::kLong);
    const torch::Tensor h = networks_.transform->forward(h0, State(row.h), action);
    Prediction answer = Judge(h0, h, row.action, /*imagined=*/true);
    answer.h = ToVector(h);
    return answer;
  }

  Prediction Judge(const torch::Tensor& h0, const torch::Tensor& h, int action, bool imagined) {
    const torch::Tensor a = torch::full({1}, action, torch::kLong);
    Prediction answer;
    if (!info_.judges) {
      const std::vector<float> none(static_cast<std::size_t>(info_.num_actions), 0.0F);
      answer.q = answer.p = none;
      return answer;
    }
    answer.value = torch::sigmoid(networks_.value->forward(h)).item<float>();
    answer.done = imagined ? torch::sigmoid(networks_.f->forward(h0, h, a)).item<float>() : 1.0F;
    answer.q = ToVector(torch::sigmoid(networks_.q->forward(h0, h, a)));
    answer.p = ToVector(torch::sigmoid(networks_.p->forward(h0, h, a)));
    return answer;
  }

  Networks networks_;
  EngineInfo info_;
  std::uint64_t weights_hash_ = 0;
  bool compose_ = true;  // pictures keep what was seen where nothing changes
  std::uint64_t fingerprint_ = 0;
  std::mutex mutex_;  // one question at a time; the pool spreads its rows
  RowPool pool_;
};

}  // namespace

std::unique_ptr<Engine> LoadTorchEngine(const std::string& path, int threads) {
  return std::make_unique<TorchEngine>(path, threads);
}

}  // namespace prospect::model
