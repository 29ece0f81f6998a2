#include "model/training/picture_scores.h"

#include <algorithm>
#include <array>
#include <mutex>
#include <string>

#include "model/training/parallel.h"
#include "model/training/picture_measures.h"

namespace prospect::model {
namespace {

using nlohmann::json;

constexpr double kChanged = 0.1;  // a pixel counts as changed from here on (any channel)

/// Sums of absolute errors of one kind of picture against noisy and clean goals.
struct ErrorSums {
  double noisy = 0, noisy_changed = 0, clean = 0, clean_changed = 0;
  double psnr = 0, ssim = 0;

  void Add(const torch::Tensor& x, const torch::Tensor& goal, const torch::Tensor& clean_goal,
           const torch::Tensor& changed) {
    psnr += Psnr(x, goal).item<double>();
    ssim += Ssim(x, goal).item<double>();
    const torch::Tensor to_goal = (x - goal).abs();
    const torch::Tensor to_clean = (x - clean_goal).abs();
    noisy += to_goal.sum().item<double>();
    noisy_changed += (to_goal * changed).sum().item<double>();
    clean += to_clean.sum().item<double>();
    clean_changed += (to_clean * changed).sum().item<double>();
  }
  void Add(const ErrorSums& o) {
    noisy += o.noisy;
    noisy_changed += o.noisy_changed;
    clean += o.clean;
    clean_changed += o.clean_changed;
    psnr += o.psnr;
    ssim += o.ssim;
  }
  void Write(const std::string& prefix, double values, double changed_values, double samples,
             json* out) const {
    (*out)[prefix + "psnr"] = psnr / samples;
    (*out)[prefix + "ssim"] = ssim / samples;
    (*out)[prefix + "mae"] = noisy / values;
    (*out)[prefix + "mae_changed"] = noisy_changed / changed_values;
    (*out)[prefix + "mae_clean"] = clean / values;
    (*out)[prefix + "mae_changed_clean"] = clean_changed / changed_values;
  }
};

/// Sums over chains of what is scored after one number of transforms.
struct StepSums {
  ErrorSums predicted, copied, reconstructed;
  double noise = 0, values = 0, changed_values = 0;
  int samples = 0;
  int labelled = 0, first = 0, second = 0, real_first = 0, real_second = 0;
  std::vector<int> of_action;

  void Add(const StepSums& o) {
    predicted.Add(o.predicted);
    copied.Add(o.copied);
    reconstructed.Add(o.reconstructed);
    noise += o.noise;
    values += o.values;
    changed_values += o.changed_values;
    samples += o.samples;
    labelled += o.labelled;
    first += o.first;
    second += o.second;
    real_first += o.real_first;
    real_second += o.real_second;
    of_action.resize(std::max(of_action.size(), o.of_action.size()));
    for (std::size_t a = 0; a < o.of_action.size(); ++a) of_action[a] += o.of_action[a];
  }

  json Pictures() const {
    const double all = std::max(1.0, values), changed = std::max(1.0, changed_values);
    json out = {{"samples", samples}, {"noise_floor", noise / all}};
    const double pictures = std::max(1, samples);
    predicted.Write("", all, changed, pictures, &out);
    copied.Write("copy_", all, changed, pictures, &out);
    reconstructed.Write("reconstruction_", all, changed, pictures, &out);
    return out;
  }
  json Labels(bool with_c) const {
    const double n = std::max(1, labelled);
    const int most = of_action.empty() ? 0 : *std::max_element(of_action.begin(), of_action.end());
    json out = {{"samples", labelled},
                {"second", second / n},
                {"real_second", real_second / n},
                {"majority", most / n}};
    if (!with_c) return out;
    out["first"] = first / n;
    out["real_first"] = real_first / n;
    return out;
  }
};

using ChainSums = std::array<StepSums, 2>;

/// Scores one chain.
class ChainScorer {
 public:
  ChainScorer(const ScoredSplit& split, const TrialFile& file, std::mutex* file_mutex)
      : split_(split),
        context_(split.context()),
        networks_(context_.networks),
        file_(file),
        file_mutex_(file_mutex) {}

  ChainSums Score(int segment) {
    const SegmentSample& first = context_.segment(segment);
    const TrialSample& trial = context_.trial(first.trial);
    const torch::Tensor h0 = split_.Hidden(trial.first);
    torch::Tensor h = split_.Hidden(first.start);
    seen_ = Seen(first.start);
    clean_start_ = Clean(first.start);
    decoded_start_ = networks_.decoder->forward(h);
    ChainSums sums;
    for (int k = 0; k < 2 && segment + k < trial.first_segment + trial.segments; ++k) {
      const SegmentSample& step = context_.segment(segment + k);
      h = networks_.transform->forward(h0, h, ActionTensor({step.action}, context_.device));
      ScorePicture(h, step, &sums[static_cast<std::size_t>(k)]);
    }
    return sums;
  }

 private:
  torch::Tensor Seen(int slot) const { return context_.pictures.Get({slot}).to(context_.device); }

  torch::Tensor Clean(int slot) const {
    const FrameRef& frame = context_.samples.frames[static_cast<std::size_t>(slot)];
    const SampleSet& s = context_.samples;
    torch::Tensor raw = torch::empty({1, s.height, s.width, 3}, torch::kUInt8);
    {
      const std::lock_guard<std::mutex> lock(*file_mutex_);  // libhdf5 is not thread-safe
      file_.ReadFrames(context_.trial(frame.trial).index, {frame.frame}, raw.data_ptr<uint8_t>());
    }
    return raw.permute({0, 3, 1, 2})
        .contiguous()
        .to(torch::kFloat)
        .div_(255.0F)
        .to(context_.device);
  }

  void ScorePicture(const torch::Tensor& h, const SegmentSample& step, StepSums* sums) {
    const torch::Tensor x = ImaginedPicture(seen_, decoded_start_, networks_.decoder->forward(h),
                                            context_.config.compose);
    const torch::Tensor goal = Seen(step.goal);
    const torch::Tensor clean = Clean(step.goal);
    const torch::Tensor changed =
        (clean - clean_start_).abs().amax(1, true).gt(kChanged).to(torch::kFloat);
    const torch::Tensor again = networks_.decoder->forward(split_.Hidden(step.goal));
    sums->predicted.Add(x, goal, clean, changed);
    sums->copied.Add(seen_, goal, clean, changed);
    sums->reconstructed.Add(again * LightGain(goal, again), goal, clean, changed);
    sums->noise += (goal - clean).abs().sum().item<double>();
    sums->values += static_cast<double>(goal.numel());
    sums->changed_values += 3.0 * changed.sum().item<double>();
    ++sums->samples;
    if (step.succeeded && networks_.has_second_classifier) ScoreLabels(x, goal, step.action, sums);
  }

  void ScoreLabels(const torch::Tensor& x, const torch::Tensor& goal, int action, StepSums* sums) {
    const auto says = [&](Classifier& classifier, const torch::Tensor& picture) {
      return classifier->forward(picture).argmax(1).item<int64_t>() == action ? 1 : 0;
    };
    sums->of_action.resize(static_cast<std::size_t>(context_.samples.num_actions));
    ++sums->of_action[static_cast<std::size_t>(action)];
    ++sums->labelled;
    sums->second += says(networks_.second_classifier, x);
    sums->real_second += says(networks_.second_classifier, goal);
    if (!networks_.has_classifier) return;
    sums->first += says(networks_.classifier, x);
    sums->real_first += says(networks_.classifier, goal);
  }

  const ScoredSplit& split_;
  const TrainContext& context_;
  Networks networks_;
  torch::Tensor seen_, clean_start_, decoded_start_;  // where the chain begins
  const TrialFile& file_;
  std::mutex* file_mutex_;
};

std::vector<int> SegmentsToScore(const ScoredSplit& split, std::size_t most) {
  std::vector<int> all;
  for (const int t : split.trials()) {
    const TrialSample& trial = split.context().trial(t);
    for (int k = 0; k < trial.segments; ++k) all.push_back(trial.first_segment + k);
  }
  const std::size_t step = (all.size() + most - 1) / most;
  std::vector<int> chosen;
  for (std::size_t i = 0; i < all.size(); i += step) chosen.push_back(all[i]);
  return chosen;
}

}  // namespace

json ScorePictures(const ScoredSplit& split, const TrialFile& file, std::size_t most_chains,
                   int threads) {
  const std::vector<int> segments = SegmentsToScore(split, most_chains);
  std::vector<ChainSums> sums(segments.size());
  std::mutex file_mutex;
  ParallelPieces(static_cast<int64_t>(segments.size()), 4,
                 split.context().device.is_cpu() ? threads : 1, [&](int64_t begin, int64_t end) {
                   const torch::NoGradGuard no_grad;
                   ChainScorer scorer(split, file, &file_mutex);
                   for (int64_t i = begin; i < end; ++i) {
                     const auto at = static_cast<std::size_t>(i);
                     sums[at] = scorer.Score(segments[at]);
                   }
                 });
  ChainSums total;
  for (const ChainSums& one : sums) {
    for (std::size_t k = 0; k < 2; ++k) total[k].Add(one[k]);
  }
  json scores = {{"chains", segments.size()},
                 {"pictures", {{"x1", total[0].Pictures()}, {"x2", total[1].Pictures()}}}};
  const Networks& networks = split.context().networks;
  if (!networks.has_second_classifier) return scores;
  const bool with_c = networks.has_classifier;
  scores["labels"] = {{"x1", total[0].Labels(with_c)}, {"x2", total[1].Labels(with_c)}};
  return scores;
}

}  // namespace prospect::model
