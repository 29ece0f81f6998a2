#include "tools/bench/engine_bench.h"

#include <algorithm>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/options/weights.h"
#include "model/engine.h"
#include "model/inference/convolution.h"
#include "model/inference/packed_matrix.h"
#include "model/weights_file.h"
#include "tools/bench/cpu_clock.h"
#include "tools/bench/engine_agreement.h"
#include "tools/bench/matrix_peak.h"

namespace prospect::tools {
namespace {

using model::inference::Grid;
using nlohmann::json;

constexpr std::uint64_t kFirstScene = 1'000'000;  // of those for tuning
constexpr int kWidth = 64;                        // channels inside T
constexpr double kLeastTime = 0.02;               // seconds a measurement takes at least

double SecondsOf(const std::function<void()>& work) {
  int times = 0;
  const CpuClock::time_point begin = CpuClock::now();
  double seconds = 0;
  do {
    work();
    ++times;
    seconds = std::chrono::duration<double>(CpuClock::now() - begin).count();
  } while (seconds < kLeastTime);
  return seconds / times;
}

double Median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

/// Medians of both in turns.
json InTurns(int pairs, double rows, const std::function<void()>& ours,
             const std::function<void()>& torch) {
  std::vector<double> our_seconds, torch_seconds;
  for (int i = 0; i < pairs; ++i) {
    our_seconds.push_back(SecondsOf(ours) / rows);
    torch_seconds.push_back(SecondsOf(torch) / rows);
  }
  const double ms = 1e3 * Median(our_seconds), torch_ms = 1e3 * Median(torch_seconds);
  return {{"ms", ms}, {"torch_ms", torch_ms}, {"ratio", torch_ms / ms}};
}

/// What is left of a layer for each row. A dense layer is a convolution of one pixel.
struct Layer {
  std::string name;
  Grid grid;
  int in, out, kernel, stride;
  bool doubling = false;
};

double MultiplyAddsOf(const Layer& layer) {
  const auto padding = model::inference::SamePadding(layer.kernel, layer.stride);
  const auto taps = [&](int length, int outputs) {
    int inside = 0;
    for (int o = 0; o < outputs; ++o) {
      const int begin = o * layer.stride - padding.before;
      inside += std::min(length, begin + layer.kernel) - std::max(0, begin);
    }
    return inside;
  };
  const Grid out = model::inference::OutputGrid(layer.grid, layer.kernel, layer.stride);
  return double(taps(layer.grid.height, out.height)) * taps(layer.grid.width, out.width) *
         layer.in * layer.out;
}

std::vector<Layer> LayersOf(const model::NetworkConfig& c) {
  const Grid grid{c.hidden_height(), c.hidden_width()}, one{1, 1};
  const int hidden = c.hidden_channels, stages = 1 + c.transform_extra_stages;
  std::vector<Layer> layers = {{"T.from_h", grid, hidden, kWidth, 1, 1},
                               {"T.merge", grid, kWidth, kWidth, 5, 1}};
  const auto at = [&](int stage) { return Grid{grid.height >> stage, grid.width >> stage}; };
  for (int i = 1; i < stages; ++i) layers.push_back({"T.down", at(i - 1), kWidth, kWidth, 5, 2});
  layers.push_back({"T.with_action", at(stages - 1), kWidth, kWidth, 5, 1});
  if (c.bottleneck == "strided") {
    layers.push_back({"T.strided", at(stages - 1), kWidth, kWidth, 5, 2});
    layers.push_back({"T.small", at(stages), kWidth, kWidth, 5, 1});
  } else {
    layers.push_back({"T.dense", one, 2 * kWidth, kWidth * at(stages).pixels(), 1, 1});
  }
  for (int i = stages; i-- > 0;) {
    layers.push_back({"T.up", at(i + 1), kWidth, 4 * kWidth, 3, 1, /*doubling=*/true});
    layers.push_back({"T.join", at(i), (c.skip ? 2 : 1) * kWidth, kWidth, 5, 1});
  }
  layers.push_back({"T.out", grid, kWidth, (c.transform_mask ? 2 : 1) * hidden, 1, 1});
  const bool costar = c.heads == "costar";
  const Grid half{grid.height / 2, grid.width / 2};
  const int flat = kWidth * (half.height / 2) * (half.width / 2), wide = costar ? 128 : 256;
  for (const char* head : {"Q", "p", "f"}) {
    const std::string name = head;
    layers.push_back({name + ".from_h", grid, hidden, 32, costar ? 4 : 1, 1});
    layers.push_back({name + ".conv1", grid, 32, 64, 4, 2});
    layers.push_back({name + ".conv2", half, 64, 64, 4, 2});
    layers.push_back({name + ".dense1", one, flat, wide, 1, 1});
    layers.push_back({name + ".dense2", one, wide, 128, 1, 1});
    layers.push_back({name + ".out", one, 128, name == "f" ? 1 : c.num_actions, 1, 1});
  }
  layers.push_back({"V.conv0", grid, hidden, 32, 4, 1});
  layers.push_back({"V.conv1", grid, 32, 64, 4, 2});
  layers.push_back({"V.conv2", half, 64, 128, 4, 2});
  layers.push_back({"V.dense", one, 2 * flat, 128, 1, 1});
  layers.push_back({"V.out", one, 128, 1, 1, 1});
  return layers;
}

json BenchLayer(const Layer& layer, int batch, int pairs, double peak) {
  const auto& kernels = model::inference::BestKernels();
  const auto taps = static_cast<std::size_t>(layer.kernel) * layer.kernel;
  const model::inference::ConvolutionWeights weights{
      layer.out, layer.in, layer.kernel, std::vector<float>(taps * layer.in * layer.out, 0.01F)};
  const auto convolution =
      layer.doubling
          ? model::inference::MakeDoubling(kernels, layer.grid, weights)
          : model::inference::MakeConvolution(kernels, layer.grid, layer.stride, weights);
  const auto maps = static_cast<std::size_t>(batch);
  const std::vector<float> in(maps * convolution->in_size(), 0.5F);
  std::vector<float> out(maps * convolution->out_size());
  model::inference::Arena arena;
  std::vector<double> seconds;
  for (int i = 0; i < pairs; ++i)
    seconds.push_back(SecondsOf([&] { convolution->Run(in.data(), batch, out.data(), arena); }));
  const double each = Median(seconds) / batch, multiply_adds = MultiplyAddsOf(layer);
  return {{"layer", layer.name},
          {"batch", batch},
          {"us", 1e6 * each},
          {"multiply_adds", multiply_adds},
          {"peak_share", 2e-9 * multiply_adds / each / peak}};
}

}  // namespace

json BenchEngine(const cli::BenchEngineOptions& options) {
  const std::string weights = cli::WeightsFile(options.weights, options.task);
  const auto engine = model::LoadEngine(weights, 1);
  const auto torch = model::LoadTorchEngine(weights, 1);
  const model::WeightsFile file = model::ReadWeights(weights);
  const std::vector<Layer> layers = LayersOf(model::NetworkConfigOf(file, weights));
  const double peak = MatrixPeakGflops(torch::kCPU, 1);
  const model::EngineInfo& info = engine->info();
  std::vector<std::uint8_t> picture(static_cast<std::size_t>(info.image_width) * info.image_height *
                                    3);
  for (std::size_t i = 0; i < picture.size(); ++i)
    picture[i] = static_cast<std::uint8_t>(i * 7 / 64);
  const model::Hidden h = engine->Encode(picture);
  double multiply_adds = 0;
  for (const Layer& layer : layers) multiply_adds += MultiplyAddsOf(layer);
  json figures = {{"task", options.task},
                  {"weights", weights},
                  {"engine", info.engine},
                  {"pairs", options.pairs},
                  {"matrix_product_gflops", peak}};
  for (const int batch : options.batches) {
    std::vector<model::ExpandInput> rows;
    for (int i = 0; i < batch; ++i) rows.push_back({h, h, i % info.num_actions});
    json row = InTurns(
        options.pairs, batch, [&] { engine->Expand(rows); }, [&] { torch->Expand(rows); });
    row["batch"] = batch;
    row["multiply_adds"] = multiply_adds;
    row["peak_share"] = 2e-6 * multiply_adds / row["ms"].get<double>() / peak;
    figures["rows"].push_back(row);
    for (const Layer& layer : layers)
      figures["layers"].push_back(BenchLayer(layer, batch, options.pairs, peak));
  }
  figures["encode"] = InTurns(
      options.pairs, 1, [&] { engine->Encode(picture); }, [&] { torch->Encode(picture); });
  figures["decode"] = InTurns(
      options.pairs, 1, [&] { engine->Decode({h}); }, [&] { torch->Decode({h}); });
  const EngineAgreement agreement =
      Compare(*engine, *torch, options.task, kFirstScene, options.scenes);
  figures["agreement"] = {{"scenes", options.scenes},         {"states", agreement.states},
                          {"judged", agreement.judged},       {"state", agreement.state},
                          {"picture", agreement.picture},     {"decisions", agreement.decisions},
                          {"differing", agreement.differing}, {"tie", agreement.tie}};
  return figures;
}

}  // namespace prospect::tools
