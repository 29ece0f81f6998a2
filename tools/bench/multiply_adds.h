// How much libtorch really computes: the multiply-adds of convolutions and matrix products.
#pragma once

#include <ATen/record_function.h>

#include <cstdint>

namespace prospect::tools {

// Counts, from its making to its end, the multiply-adds of every convolution and matrix product
// that any thread of this process carries out, the backward pass apart. What is not computed is
// not counted: no gradients of frozen weights, none of a first layer's input. Everything else
// (norms, activations, optimizer) is left out: it is small, and no matrix product could do it.
// Transposed convolutions and batched products, which our networks have none of, are not counted.
//
// One at a time; libtorch must be idle when it is made and when it ends.
class MultiplyAdds {
 public:
  MultiplyAdds();
  ~MultiplyAdds();
  MultiplyAdds(const MultiplyAdds&) = delete;
  MultiplyAdds& operator=(const MultiplyAdds&) = delete;

  static std::int64_t forward();
  static std::int64_t backward();

 private:
  at::CallbackHandle handle_;
};

}  // namespace prospect::tools
