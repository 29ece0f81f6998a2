#include "model/novelty.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "model/half.h"
#include "model/weights_file.h"

namespace prospect::model {
namespace {

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Eigen::Index;
using Eigen::VectorXd;

constexpr int kGrid = 8;                 // cells of a residual, each way
constexpr std::size_t kFewest = 16;      // samples of each kind
constexpr Index kMostAxes = 256;         // kept; what lies outside them counts as one more
constexpr double kResidualFloor = 0.03;  // share of the mean variance added to each axis' own
constexpr double kStateFloor = 0.003;
constexpr double kKnown = 0.99;  // share of known pictures that limits are told for

/// As the file holds it, so that what is ranked is what will be judged by.
double Stored(double value) { return HalfToFloat(FloatToHalf(static_cast<float>(value))); }

template <typename Numbers>
Numbers AllStored(Numbers numbers) {
  return numbers.unaryExpr([](double value) { return Stored(value); });
}

template <typename Member>
Matrix RowsOf(const std::vector<NoveltySample>& samples, Member member) {
  const auto width = static_cast<Index>((samples.front().*member).size());
  Matrix rows(static_cast<Index>(samples.size()), width);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const std::vector<float>& values = samples[i].*member;
    if (static_cast<Index>(values.size()) != width)
      throw std::invalid_argument("novelty: samples of different sizes");
    std::copy(values.begin(), values.end(), rows.row(static_cast<Index>(i)).begin());
  }
  return rows;
}

/// Where vectors of one kind lie, and how far out the ranked ones are.
struct Spread {
  VectorXd mean;              // [D]
  Matrix axes;                // [K,D], of unit length
  VectorXd scale;             // [K + 1]: one over the spread along each axis, and across all others
  std::vector<double> ranks;  // ascending

  /// Root mean square of a vector [D], in units of the spread.
  double Distance(const VectorXd& values) const {
    const VectorXd away = values - mean;
    const VectorXd along = axes * away;
    const double across = std::max(0.0, away.squaredNorm() - along.squaredNorm());
    const double far = along.cwiseProduct(scale.head(along.size())).squaredNorm() +
                       across * scale[along.size()] * scale[along.size()];
    return std::sqrt(far / static_cast<double>(mean.size()));
  }
};

/// Principal axes with the greatest variance, each variance lifted by `floor` of their mean, so
/// that directions in which hardly anything was seen to vary do not drown the others.
Spread SpreadOf(const Matrix& rows, double floor) {
  const Index dimensions = rows.cols(), kept = std::min(kMostAxes, dimensions);
  Spread spread;
  spread.mean = AllStored(VectorXd(rows.colwise().mean()));
  const Matrix away = rows.rowwise() - spread.mean.transpose();
  const Eigen::MatrixXd covariance = away.transpose() * away / static_cast<double>(rows.rows());
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solved(covariance);  // ascending
  const VectorXd values = solved.eigenvalues().cwiseMax(0.0);
  const double lift = floor * solved.eigenvalues().mean();
  spread.axes = AllStored(Matrix(solved.eigenvectors().rightCols(kept).transpose()));
  VectorXd variances(kept + 1);
  variances.head(kept) = values.tail(kept).array() + lift;
  variances[kept] = kept < dimensions ? values.head(dimensions - kept).mean() + lift : lift;
  spread.scale = AllStored(VectorXd(variances.cwiseMax(1e-8).cwiseSqrt().cwiseInverse()));
  return spread;
}

Spread Ranked(Spread spread, const Matrix& rows) {
  for (Index i = 0; i < rows.rows(); ++i)
    spread.ranks.push_back(Stored(spread.Distance(rows.row(i).transpose())));
  std::sort(spread.ranks.begin(), spread.ranks.end());
  return spread;
}

/// Of ascending `ranks` the share at least as far out as `distance`, itself among them. What is
/// compared is rounded as the ranks are.
double ShareBeyond(const std::vector<double>& ranks, double distance) {
  const auto first = std::lower_bound(ranks.begin(), ranks.end(), Stored(distance));
  return (1 + static_cast<double>(ranks.end() - first)) / (static_cast<double>(ranks.size()) + 1);
}

double LimitOf(const std::vector<double>& ranks) {
  const auto at =
      static_cast<std::ptrdiff_t>(std::ceil(kKnown * static_cast<double>(ranks.size())));
  const auto last = static_cast<std::ptrdiff_t>(ranks.size()) - 1;
  return ranks[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(at - 1, 0, last))];
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

Hidden Unturned(const Hidden& state, const EngineInfo& info) {
  return {state.begin(), state.begin() + info.hidden_size / info.turns};
}

NoveltySample TakeNoveltySample(Engine& engine, Pixels picture) {
  const EngineInfo& info = engine.info();
  const Hidden state = engine.Encode(picture);
  return CompareRedrawn(picture, engine.Decode({state}).at(0), info.image_width, info.image_height,
                        Unturned(state, info));
}

NoveltyGauge::NoveltyGauge(const std::vector<NoveltySample>& fit,
                           const std::vector<NoveltySample>& rank) {
  if (fit.size() < kFewest || rank.size() < kFewest)
    throw std::invalid_argument("novelty: too few known pictures to compare with");
  auto parts = std::make_shared<Parts>();
  parts->residual = Ranked(SpreadOf(RowsOf(fit, &NoveltySample::residual), kResidualFloor),
                           RowsOf(rank, &NoveltySample::residual));
  parts->state = Ranked(SpreadOf(RowsOf(fit, &NoveltySample::state), kStateFloor),
                        RowsOf(rank, &NoveltySample::state));
  std::vector<double> errors;
  for (const NoveltySample& sample : rank) errors.push_back(sample.error);
  std::sort(errors.begin(), errors.end());
  parts->error_limit = LimitOf(errors);
  parts_ = std::move(parts);
}

std::size_t NoveltyGauge::ranked() const { return parts_->state.ranks.size(); }

Novelty NoveltyGauge::Judge(const NoveltySample& sample) const {
  const auto distance = [](const Spread& spread, const std::vector<float>& values) {
    if (static_cast<Index>(values.size()) != spread.mean.size())
      throw std::invalid_argument("novelty: a sample of another size than the known ones");
    const auto known = Eigen::Map<const Eigen::VectorXf>(values.data(), spread.mean.size());
    return spread.Distance(known.cast<double>());
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

StoredTensor StoredMatrix(const Matrix& matrix) {
  return HalfTensor({matrix.rows(), matrix.cols()},
                    std::vector<float>(matrix.data(), matrix.data() + matrix.size()));
}

template <typename Numbers>
StoredTensor StoredVector(const Numbers& numbers) {
  return HalfTensor({static_cast<std::int64_t>(numbers.size())},
                    std::vector<float>(numbers.begin(), numbers.end()));
}

void Put(const char* kind, const Spread& spread, std::map<std::string, StoredTensor>* tensors) {
  (*tensors)[TensorName(kind, "mean")] = StoredVector(spread.mean);
  (*tensors)[TensorName(kind, "axes")] = StoredMatrix(spread.axes);
  (*tensors)[TensorName(kind, "scale")] = StoredVector(spread.scale);
  (*tensors)[TensorName(kind, "ranks")] = StoredVector(spread.ranks);
}

[[noreturn]] void RefuseGauge(const std::string& path) {
  throw WeightsError(path +
                     ": what it holds of known pictures is damaged; "
                     "./prospect evaluate novelty makes it anew");
}

/// The numbers of a tensor of `rank` extents, none of which is 0, as a matrix of its last extent.
Matrix Take(const WeightsFile& file, const std::string& path, const char* kind, const char* part,
            std::size_t rank) {
  const auto found = file.tensors.find(TensorName(kind, part));
  if (found == file.tensors.end() || found->second.shape.size() != rank) RefuseGauge(path);
  const std::vector<float> values = ToFloats(found->second);
  if (values.empty() || !AllFinite(values)) RefuseGauge(path);
  const auto count = static_cast<Index>(values.size()), width = Index{found->second.shape.back()};
  Matrix matrix(count / width, width);
  std::copy(values.begin(), values.end(), matrix.data());
  return matrix;
}

Spread TakeSpread(const WeightsFile& file, const std::string& path, const char* kind) {
  Spread spread;
  spread.mean = Take(file, path, kind, "mean", 1).row(0);
  spread.axes = Take(file, path, kind, "axes", 2);
  spread.scale = Take(file, path, kind, "scale", 1).row(0);
  const Matrix ranks = Take(file, path, kind, "ranks", 1);
  spread.ranks.assign(ranks.data(), ranks.data() + ranks.size());
  const bool fits = spread.axes.cols() == spread.mean.size() &&
                    spread.scale.size() == spread.axes.rows() + 1 &&
                    std::is_sorted(spread.ranks.begin(), spread.ranks.end());
  if (!fits) RefuseGauge(path);
  return spread;
}

}  // namespace

std::optional<NoveltyGauge> NoveltyGauge::Load(const std::string& weights_path) {
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
