#include "tools/bench/matrix_peak.h"

#include <algorithm>
#include <chrono>
#include <functional>

#include "model/training/parallel.h"

namespace prospect::tools {
namespace {

constexpr int kTries = 8;
constexpr std::int64_t kCpuSize = 1024, kCudaSize = 8192;  // rows and columns
constexpr int kCpuProducts = 3, kCudaProducts = 10;        // in a row, for a measurable time

double GigaFlops(std::int64_t size, std::int64_t products) {
  const auto n = static_cast<double>(size);
  return 2e-9 * n * n * n * static_cast<double>(products);
}

double LeastSeconds(const std::function<void()>& work) {
  using Clock = std::chrono::steady_clock;
  double least = 1e9;
  for (int i = 0; i < kTries; ++i) {
    const Clock::time_point begin = Clock::now();
    work();
    least = std::min(least, std::chrono::duration<double>(Clock::now() - begin).count());
  }
  return least;
}

void Multiply(const torch::TensorOptions& options, std::int64_t size, int products) {
  const torch::NoGradGuard no_grad;
  const torch::Tensor a = torch::full({size, size}, 0.5, options);
  torch::Tensor c = torch::empty({size, size}, options);
  for (int i = 0; i < products; ++i) torch::mm_out(c, a, a);
}

double CpuGflops(int threads) {
  const double seconds = LeastSeconds([threads] {
    model::ParallelPieces(threads, 1, threads, [](std::int64_t, std::int64_t) {
      Multiply(torch::kFloat, kCpuSize, kCpuProducts);
    });
  });
  return GigaFlops(kCpuSize, static_cast<std::int64_t>(kCpuProducts) * threads) / seconds;
}

double CudaGflops(const torch::Device& device, torch::Dtype type) {
  const double seconds = LeastSeconds([&] {
    Multiply(torch::TensorOptions(type).device(device), kCudaSize, kCudaProducts);
    torch::cuda::synchronize();
  });
  return GigaFlops(kCudaSize, kCudaProducts) / seconds;
}

}  // namespace

double MatrixPeakGflops(const torch::Device& device, int threads) {
  if (device.is_cpu()) return CpuGflops(threads);
  return std::max(CudaGflops(device, torch::kFloat), CudaGflops(device, torch::kHalf));
}

}  // namespace prospect::tools
