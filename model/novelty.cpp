#include "model/novelty.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "model/networks/libtorch.h"
#include "model/weights.h"

namespace prospect::model {
namespace {

constexpr int kGrid = 8;                 // cells of a residual, each way
constexpr std::size_t kFewest = 16;      // samples of each kind
constexpr int64_t kMostAxes = 256;       // kept; what lies outside them counts as one more
constexpr double kResidualFloor = 0.03;  // share of the mean variance added to each axis' own
constexpr double kStateFloor = 0.003;
constexpr double kKnown = 0.99;  // share of known pictures that limits are told for

/// As the file holds it, so that what is ranked is what will be judged by.
torch::Tensor Stored(const torch::Tensor& tensor) {
  return tensor.to(torch::kHalf).to(torch::kFloat).contiguous();
}

torch::Tensor Rows(const std::vector<const std::vector<float>*>& rows) {
  const auto width = static_cast<int64_t>(rows.front()->size());
  torch::Tensor all = torch::empty({static_cast<int64_t>(rows.size()), width});
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (static_cast<int64_t>(rows[i]->size()) != width)
      throw std::invalid_argument("novelty: samples of different sizes");
    std::copy(rows[i]->begin(), rows[i]->end(), all[static_cast<int64_t>(i)].data_ptr<float>());
  }
  return all;
}

template <typename Member>
torch::Tensor RowsOf(const std::vector<NoveltySample>& samples, Member member) {
  std::vector<const std::vector<float>*> rows;
  for (const NoveltySample& sample : samples) rows.push_back(&(sample.*member));
  return Rows(rows);
}

/// Where vectors of one kind lie, and how far out the ranked ones are.
struct Spread {
  torch::Tensor mean;   // [D]
  torch::Tensor axes;   // [K,D], of unit length
  torch::Tensor scale;  // [K + 1]: one over the spread along each axis, and across all others
  torch::Tensor ranks;  // [N], ascending

  /// Root mean squares of rows [B,D] -> [B], in units of the spread.
  torch::Tensor Distance(const torch::Tensor& rows) const {
    const torch::Tensor away = rows - mean;
    const torch::Tensor along = torch::mm(away, axes.t());
    const torch::Tensor across =
        (away.square().sum(1) - along.square().sum(1)).clamp_min(0.0).sqrt();
    const torch::Tensor all = torch::cat({along, across.unsqueeze(1)}, 1) * scale;
    return (all.square().sum(1) / static_cast<double>(mean.size(0))).sqrt();
  }
};

/// Principal axes with the greatest variance, each variance lifted by `floor` of their mean, so
/// that directions in which hardly anything was seen to vary do not drown the others.
Spread SpreadOf(const torch::Tensor& rows, double floor) {
  const int64_t dimensions = rows.size(1), kept = std::min(kMostAxes, dimensions);
  Spread spread;
  spread.mean = Stored(rows.mean(0));
  const torch::Tensor away = (rows - spread.mean).to(torch::kDouble);
  const torch::Tensor covariance = torch::mm(away.t(), away) / static_cast<double>(rows.size(0));
  const auto [values, vectors] = torch::linalg_eigh(covariance);  // ascending
  const torch::Tensor lifted = values.clamp_min(0.0) + floor * values.mean();
  spread.axes = Stored(vectors.slice(1, dimensions - kept).t());
  const torch::Tensor others =
      kept < dimensions ? lifted.slice(0, 0, dimensions - kept).mean() : floor * values.mean();
  const torch::Tensor variances =
      torch::cat({lifted.slice(0, dimensions - kept), others.reshape({1})});
  spread.scale = Stored(variances.clamp_min(1e-8).rsqrt());
  return spread;
}

Spread Ranked(Spread spread, const torch::Tensor& rows) {
  spread.ranks = Stored(std::get<0>(spread.Distance(rows).sort()));
  return spread;
}

/// Of ascending `ranks` the share at least as far out as `distance`, itself among them. What is
/// compared is rounded as the ranks are.
double ShareBeyond(const torch::Tensor& ranks, double distance) {
  const float rounded = Stored(torch::tensor(static_cast<float>(distance))).item<float>();
  const float* begin = ranks.data_ptr<float>();
  const float* end = begin + ranks.numel();
  const auto beyond = static_cast<double>(end - std::lower_bound(begin, end, rounded));
  return (1 + beyond) / (static_cast<double>(ranks.numel()) + 1);
}

double LimitOf(const torch::Tensor& ranks) {
  const auto at = static_cast<int64_t>(std::ceil(kKnown * static_cast<double>(ranks.numel()))) - 1;
  return ranks[std::clamp<int64_t>(at, 0, ranks.numel() - 1)].item<float>();
}

/// The light of `picture` over that of `redrawn`, by least squares.
double GainOf(Pixels picture, const std::vector<std::uint8_t>& redrawn) {
  double both = 0, own = 0;
  for (std::size_t i = 0; i < redrawn.size(); ++i) {
    both += static_cast<double>(picture[i]) * redrawn[i];
    own += static_cast<double>(redrawn[i]) * redrawn[i];
  }
  return own > 0 ? both / own : 1;
}

constexpr double kDarkest = 1e-3;  // gain below which there is no light to bring up

}  // namespace

struct NoveltyGauge::Parts {
  Spread residual, state;
  double error_limit = 0;
};

NoveltySample CompareRedrawn(Pixels picture, const std::vector<std::uint8_t>& redrawn, int width,
                             int height, Hidden state) {
  if (width % kGrid != 0 || height % kGrid != 0 || picture.size() != redrawn.size() ||
      redrawn.size() != static_cast<std::size_t>(width) * height * 3) {
    throw std::invalid_argument("novelty: a picture of a size that the networks do not have");
  }
  NoveltySample sample;
  sample.residual.assign(kGrid * kGrid * 3, 0.0F);
  sample.state = std::move(state);
  const double gain = std::max(kDarkest, GainOf(picture, redrawn));
  const int cell_width = width / kGrid, cell_height = height / kGrid;
  const double cell = 255.0 * cell_width * cell_height;
  for (std::size_t i = 0; i < redrawn.size(); ++i) {
    const auto pixel = static_cast<int>(i / 3);
    const int column = pixel % width / cell_width, row = pixel / width / cell_height;
    const double difference = picture[i] / gain - redrawn[i];
    sample.residual[static_cast<std::size_t>((row * kGrid + column) * 3) + i % 3] +=
        static_cast<float>(difference / cell);
    sample.error += std::abs(difference);
  }
  sample.error /= 255.0 * static_cast<double>(redrawn.size());
  return sample;
}

NoveltySample TakeNoveltySample(Engine& engine, Pixels picture) {
  const Hidden state = engine.Encode(picture);
  return CompareRedrawn(picture, engine.Decode({state}).at(0), engine.info().image_width,
                        engine.info().image_height, state);
}

NoveltyGauge::NoveltyGauge(const std::vector<NoveltySample>& fit,
                           const std::vector<NoveltySample>& rank) {
  if (fit.size() < kFewest || rank.size() < kFewest)
    throw std::invalid_argument("novelty: too few known pictures to compare with");
  const c10::InferenceMode inference;
  auto parts = std::make_shared<Parts>();
  const torch::Tensor residuals = RowsOf(rank, &NoveltySample::residual);
  const torch::Tensor states = RowsOf(rank, &NoveltySample::state);
  parts->residual =
      Ranked(SpreadOf(RowsOf(fit, &NoveltySample::residual), kResidualFloor), residuals);
  parts->state = Ranked(SpreadOf(RowsOf(fit, &NoveltySample::state), kStateFloor), states);
  std::vector<float> errors;
  for (const NoveltySample& sample : rank) errors.push_back(static_cast<float>(sample.error));
  std::sort(errors.begin(), errors.end());
  parts->error_limit = LimitOf(torch::tensor(c10::ArrayRef<float>(errors.data(), errors.size())));
  parts_ = std::move(parts);
}

std::size_t NoveltyGauge::ranked() const {
  return static_cast<std::size_t>(parts_->state.ranks.numel());
}

Novelty NoveltyGauge::Judge(const NoveltySample& sample) const {
  const c10::InferenceMode inference;
  const auto distance = [](const Spread& spread, const std::vector<float>& values) {
    if (static_cast<int64_t>(values.size()) != spread.mean.size(0))
      throw std::invalid_argument("novelty: a sample of another size than the known ones");
    return static_cast<double>(spread.Distance(Rows({&values})).item<float>());
  };
  Novelty novelty;
  novelty.error = sample.error;
  novelty.error_limit = parts_->error_limit;
  novelty.residual = distance(parts_->residual, sample.residual);
  novelty.residual_limit = LimitOf(parts_->residual.ranks);
  novelty.state = distance(parts_->state, sample.state);
  novelty.state_limit = LimitOf(parts_->state.ranks);
  novelty.p = std::min(1.0, 2 * std::min(ShareBeyond(parts_->residual.ranks, novelty.residual),
                                         ShareBeyond(parts_->state.ranks, novelty.state)));
  return novelty;
}

namespace {

constexpr const char* kKinds[] = {"residual", "state"};

std::string TensorName(const char* kind, const char* part) {
  return std::string("novelty.") + kind + "." + part;
}

void Put(const char* kind, const Spread& spread, std::map<std::string, torch::Tensor>* tensors) {
  (*tensors)[TensorName(kind, "mean")] = spread.mean;
  (*tensors)[TensorName(kind, "axes")] = spread.axes;
  (*tensors)[TensorName(kind, "scale")] = spread.scale;
  (*tensors)[TensorName(kind, "ranks")] = spread.ranks;
}

[[noreturn]] void RefuseGauge(const std::string& path) {
  throw WeightsError(path +
                     ": what it holds of known pictures is damaged; "
                     "./prospect evaluate novelty makes it anew");
}

torch::Tensor Take(const WeightsFile& file, const std::string& path, const char* kind,
                   const char* part, int64_t dimensions) {
  const auto found = file.tensors.find(TensorName(kind, part));
  if (found == file.tensors.end() || found->second.dim() != dimensions ||
      found->second.numel() == 0)
    RefuseGauge(path);
  torch::Tensor tensor = found->second.to(torch::kFloat).contiguous();
  if (!torch::isfinite(tensor).all().item<bool>()) RefuseGauge(path);
  return tensor;
}

Spread TakeSpread(const WeightsFile& file, const std::string& path, const char* kind) {
  Spread spread;
  spread.mean = Take(file, path, kind, "mean", 1);
  spread.axes = Take(file, path, kind, "axes", 2);
  spread.scale = Take(file, path, kind, "scale", 1);
  spread.ranks = Take(file, path, kind, "ranks", 1);
  const bool fits =
      spread.axes.size(1) == spread.mean.size(0) && spread.scale.size(0) == spread.axes.size(0) + 1;
  const float* ranks = spread.ranks.data_ptr<float>();
  if (!fits || !std::is_sorted(ranks, ranks + spread.ranks.numel())) RefuseGauge(path);
  return spread;
}

}  // namespace

std::optional<NoveltyGauge> NoveltyGauge::Load(const std::string& weights_path) {
  const c10::InferenceMode inference;
  const WeightsFile file = ReadWeights(weights_path);
  if (!file.metadata.contains("novelty")) return std::nullopt;
  auto parts = std::make_shared<Parts>();
  parts->residual = TakeSpread(file, weights_path, kKinds[0]);
  parts->state = TakeSpread(file, weights_path, kKinds[1]);
  const auto& about = file.metadata["novelty"];
  if (!about.is_object() || !about.contains("error_limit") || !about["error_limit"].is_number())
    RefuseGauge(weights_path);
  parts->error_limit = about["error_limit"].get<double>();
  return NoveltyGauge(std::move(parts));
}

void StoreNovelty(const std::string& weights_path, const NoveltyGauge& gauge,
                  const NoveltySource& source) {
  WeightsFile file = ReadWeights(weights_path);
  Put(kKinds[0], gauge.parts_->residual, &file.tensors);
  Put(kKinds[1], gauge.parts_->state, &file.tensors);
  file.metadata["novelty"] = {{"error_limit", gauge.parts_->error_limit},
                              {"first_seed", source.first_seed},
                              {"fitted", source.fitted},
                              {"ranked", source.ranked},
                              {"command", source.command}};
  WriteWeights(weights_path, file.tensors, file.metadata);
}

}  // namespace prospect::model
