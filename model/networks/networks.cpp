#include "model/networks/networks.h"

namespace prospect::model {

Networks::Networks(const NetworkConfig& c)
    : config(c),
      encoder(c),
      decoder(c),
      transform(c),
      value(c),
      q(c, c.num_actions),
      p(c, c.num_actions),
      f(c, 1),
      classifier(c),
      second_classifier(c) {}

std::vector<std::pair<std::string, torch::nn::Module*>> Networks::named() const {
  return {{"encoder", encoder.ptr().get()},
          {"decoder", decoder.ptr().get()},
          {"transform", transform.ptr().get()},
          {"value", value.ptr().get()},
          {"q", q.ptr().get()},
          {"p", p.ptr().get()},
          {"f", f.ptr().get()},
          {"classifier", classifier.ptr().get()},
          {"second_classifier", second_classifier.ptr().get()}};
}

bool Networks::Has(const std::string& name) const {
  if (name == "classifier") return has_classifier;
  if (name == "second_classifier") return has_second_classifier;
  return has_heads || !IsHead(name);
}

bool IsHead(const std::string& name) {
  return name == "value" || name == "q" || name == "p" || name == "f";
}

void Networks::SetTraining(bool on) const {
  for (const auto& [name, module] : named()) module->train(on);
}

void Networks::To(const torch::Device& device) const {
  for (const auto& [name, module] : named()) module->to(device);
}

int64_t ParameterCount(const torch::nn::Module& module) {
  int64_t count = 0;
  for (const torch::Tensor& tensor : module.parameters()) count += tensor.numel();
  return count;
}

}  // namespace prospect::model
