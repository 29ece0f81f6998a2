#include "tools/bench/multiply_adds.h"

#include <torch/torch.h>

#include <atomic>
#include <cstring>
#include <memory>

namespace prospect::tools {
namespace {

std::atomic<std::int64_t> forward_sum{0}, backward_sum{0};
thread_local int backward_depth = 0;  // nodes of the backward pass that this thread is in
thread_local int product_depth = 0;   // products: one may be carried out by another one

enum class Kind { kNone, kConvolution, kConvolutionBackward, kProduct, kSumAndProduct };

Kind KindOf(const char* name) {
  if (std::strcmp(name, "aten::convolution") == 0) return Kind::kConvolution;
  if (std::strcmp(name, "aten::convolution_backward") == 0) return Kind::kConvolutionBackward;
  if (std::strcmp(name, "aten::mm") == 0) return Kind::kProduct;
  if (std::strcmp(name, "aten::addmm") == 0) return Kind::kSumAndProduct;
  return Kind::kNone;
}

// Of one product, from its beginning to its end.
struct Product : at::ObserverContext {
  std::int64_t whole = 0;        // multiply-adds known at its beginning
  std::int64_t each_output = 0;  // and those for each number of its output
};

std::int64_t OfRows(const at::Tensor& a, const at::Tensor& b) {
  return a.size(0) * a.size(1) * b.size(1);
}

// For each output pixel and channel: input channels x kernel.
std::int64_t OfKernel(const at::Tensor& weight) { return weight.numel() / weight.size(0); }

std::unique_ptr<Product> ProductOf(Kind kind, c10::ArrayRef<const c10::IValue> inputs) {
  auto product = std::make_unique<Product>();
  const auto tensor = [&inputs](std::size_t i) { return inputs[i].toTensor(); };
  if (kind == Kind::kConvolution) product->each_output = OfKernel(tensor(1));
  if (kind == Kind::kConvolutionBackward) {
    const c10::List<bool> wanted = inputs[10].toBoolList();  // gradients of input, weight, bias
    product->whole = tensor(0).numel() * OfKernel(tensor(2)) * (wanted[0] + wanted[1]);
  }
  if (kind == Kind::kProduct) product->whole = OfRows(tensor(0), tensor(1));
  if (kind == Kind::kSumAndProduct) product->whole = OfRows(tensor(1), tensor(2));
  return product;
}

std::unique_ptr<at::ObserverContext> Begin(const at::RecordFunction& function) {
  if (function.scope() == at::RecordScope::BACKWARD_FUNCTION) {
    ++backward_depth;
    return nullptr;
  }
  const Kind kind = KindOf(function.name());
  if (kind == Kind::kNone) return nullptr;
  if (product_depth++ > 0) return std::make_unique<Product>();  // counted already
  return ProductOf(kind, function.inputs());
}

void End(const at::RecordFunction& function, at::ObserverContext* context) {
  if (function.scope() == at::RecordScope::BACKWARD_FUNCTION) {
    --backward_depth;
    return;
  }
  if (context == nullptr) return;
  --product_depth;
  const auto* product = static_cast<const Product*>(context);
  std::int64_t count = product->whole;
  if (product->each_output > 0) {
    count += product->each_output * function.outputs()[0].toTensor().numel();
  }
  (backward_depth > 0 ? backward_sum : forward_sum) += count;
}

}  // namespace

MultiplyAdds::MultiplyAdds() {
  forward_sum = backward_sum = 0;
  handle_ = at::addGlobalCallback(
      at::RecordFunctionCallback(Begin, End)
          .needsInputs(true)
          .needsOutputs(true)
          .scopes({at::RecordScope::FUNCTION, at::RecordScope::BACKWARD_FUNCTION}));
}

MultiplyAdds::~MultiplyAdds() { at::removeCallback(handle_); }

std::int64_t MultiplyAdds::forward() { return forward_sum; }
std::int64_t MultiplyAdds::backward() { return backward_sum; }

}  // namespace prospect::tools
