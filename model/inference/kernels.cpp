#include "model/inference/kernels.h"

namespace prospect::model::inference {

extern const Kernels kPortableKernels;
#if defined(__x86_64__)
extern const Kernels kAvx512Kernels, kAvx2Kernels;
#endif

std::vector<const Kernels*> RunnableKernels() {
  std::vector<const Kernels*> runnable;
#if defined(__x86_64__)
  const bool fma = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  if (fma && __builtin_cpu_supports("avx512f")) runnable.push_back(&kAvx512Kernels);
  if (fma) runnable.push_back(&kAvx2Kernels);
#endif
  runnable.push_back(&kPortableKernels);
  return runnable;
}

const Kernels& BestKernels() {
  static const Kernels* const best = RunnableKernels().front();
  return *best;
}

}  // namespace prospect::model::inference
