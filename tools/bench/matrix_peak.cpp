#include "tools/bench/matrix_peak.h"

#include <algorithm>
#include <chrono>
#include <functional>
#include <numeric>
#include <vector>

#include "model/training/parallel.h"
#include "tools/bench/cpu_clock.h"

namespace prospect::tools {
namespace {

constexpr int kTries = 8;
constexpr std::int64_t kCpuSize = 1024, kCudaSize = 8192;  // rows and columns
constexpr int kCpuProducts = 3, kCudaProducts = 10;        // in a row, for a measurable time

double GigaFlops(std::int64_t size, std::int64_t products) {
  const auto n = static_cast<double>(size);
  return 2e-9 * n * n * n * static_cast<double>(products);
}

template <typename Clock>
double SecondsOf(const std::function<void()>& work) {
  const auto begin = Clock::now();
  work();
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

double LeastOf(const std::function<double()>& seconds) {
  double least = 1e9;
  for (int i = 0; i < kTries; ++i) least = std::min(least, seconds());
  return least;
}

void Multiply(const torch::TensorOptions& options, std::int64_t size, int products) {
  const torch::NoGradGuard no_grad;
  const torch::Tensor a = torch::full({size, size}, 0.5, options);
  torch::Tensor c = torch::empty({size, size}, options);
  for (int i = 0; i < products; ++i) torch::mm_out(c, a, a);
}

/// By the threads' own processor time: what else runs on the machine lowers no peak.
double CpuGflops(int threads) {
  const double seconds = LeastOf([threads] {
    std::vector<double> each(static_cast<std::size_t>(threads));
    model::ParallelPieces(threads, 1, threads, [&](std::int64_t begin, std::int64_t) {
      each[static_cast<std::size_t>(begin)] =
          SecondsOf<CpuClock>([] { Multiply(torch::kFloat, kCpuSize, kCpuProducts); });
    });
    return std::accumulate(each.begin(), each.end(), 0.0) / threads;
  });
  return GigaFlops(kCpuSize, static_cast<std::int64_t>(kCpuProducts) * threads) / seconds;
}

double CudaGflops(const torch::Device& device, torch::Dtype type) {
  const double seconds = LeastOf([&] {
    return SecondsOf<std::chrono::steady_clock>([&] {
      Multiply(torch::TensorOptions(type).device(device), kCudaSize, kCudaProducts);
      torch::cuda::synchronize();
    });
  });
  return GigaFlops(kCudaSize, kCudaProducts) / seconds;
}

}  // namespace

double MatrixPeakGflops(const torch::Device& device, int threads) {
  if (device.is_cpu()) return CpuGflops(threads);
  return std::max(CudaGflops(device, torch::kFloat), CudaGflops(device, torch::kHalf));
}

}  // namespace prospect::tools
