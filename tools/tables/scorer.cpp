#include "tools/tables/scorer.h"

#include <algorithm>
#include <map>
#include <mutex>

#include "base/sensor_noise.h"
#include "model/networks/light.h"
#include "model/training/parallel.h"
#include "model/training/picture_measures.h"
#include "tools/tables/examples.h"

namespace prospect::tools {
namespace {

using torch::Tensor;

constexpr std::size_t kChunk = 16;  // examples computed at once
constexpr int kExtrasEvery = 5;     // composed pictures and C's own labels: of so many examples one

/// The pictures of one trial, [N,3,H,W] in [0,1].
struct TrialPictures {
  model::Trial labels;
  Tensor clean, seen;

  Tensor Clean(const std::vector<int64_t>& frames) const { return Rows(clean, frames); }
  Tensor Seen(const std::vector<int64_t>& frames) const { return Rows(seen, frames); }

 private:
  static Tensor Rows(const Tensor& all, const std::vector<int64_t>& frames) {
    return all.index_select(0, torch::tensor(frames)).to(torch::kFloat).div_(255.0F);
  }
};

Tensor AsPictures(std::vector<std::uint8_t>* bytes, const model::Trial& t) {
  return torch::from_blob(bytes->data(), {t.frames(), t.height, t.width, 3}, torch::kUInt8)
      .permute({0, 3, 1, 2})
      .contiguous();
}

TrialPictures PicturesOf(model::Trial trial) {
  TrialPictures pictures;
  pictures.clean = AsPictures(&trial.images, trial);
  for (int i = 0; i < trial.frames(); ++i) {
    base::AddSensorNoise(trial.images.data() + i * trial.frame_bytes(), trial.frame_bytes(),
                         trial.seed, i, trial.image_noise);
  }
  pictures.seen = AsPictures(&trial.images, trial);
  trial.images.clear();
  pictures.labels = std::move(trial);
  return pictures;
}

Tensor Errors(const Tensor& x, const Tensor& clean_goal) {
  return (x - clean_goal).abs().mean({1, 2, 3});
}

double Hits(const model::Classifier& judge, const Tensor& x, const Tensor& action) {
  if (judge.is_empty()) return 0;
  model::Classifier reader = judge;
  return reader->forward(x).argmax(1).eq(action).sum().item<double>();
}

/// Some examples of one trial as columns.
struct Chunk {
  std::size_t first;  ///< number of the first one among the trial's examples
  std::vector<int64_t> frames, goals1, goals2;
  Tensor action1, action2;

  Chunk(const std::vector<Example>& examples, std::size_t begin, std::size_t end) : first(begin) {
    std::vector<int64_t> a1, a2;
    for (std::size_t i = begin; i < end; ++i) {
      frames.push_back(examples[i].frame);
      goals1.push_back(examples[i].goal1);
      goals2.push_back(examples[i].goal2);
      a1.push_back(examples[i].action1);
      a2.push_back(examples[i].action2);
    }
    action1 = torch::tensor(a1);
    action2 = torch::tensor(a2);
  }
};

/// Scores the examples of one trial. One object a trial and thread.
class TrialScorer {
 public:
  TrialScorer(const TableData& data, const model::Networks& networks,
              const model::Classifier& judge, TrialPictures pictures)
      : data_(data), networks_(networks), judge_(judge), pictures_(std::move(pictures)) {}

  TrialSums OfModel() {
    const Tensor first = pictures_.Seen({0});
    h0_ = networks_.encoder->forward(first);
    gain_ = model::LightGain(first, networks_.decoder->forward(h0_));
    return Sum([this](const Chunk& chunk, TrialSums* sums) { AddPredictions(chunk, sums); });
  }
  TrialSums OfCopy() {
    return Sum([this](const Chunk& chunk, TrialSums* sums) {
      const Tensor x = pictures_.Seen(chunk.frames);
      AddPictures(x, x, chunk, sums);
    });
  }
  TrialSums OfGoals() {
    return SumOfGoals([this](int frame) { return pictures_.Seen({frame}); });
  }
  TrialSums OfReconstruction() {
    return SumOfGoals([this](int frame) { return Reconstruct(frame); });
  }

 private:
  template <typename AddFn>
  TrialSums Sum(const AddFn& add) {
    const std::vector<Example> examples =
        ExamplesOf(pictures_.labels, data_.every, data_.paper_tail);
    TrialSums sums;
    for (std::size_t begin = 0; begin < examples.size(); begin += kChunk) {
      const Chunk chunk(examples, begin, std::min(examples.size(), begin + kChunk));
      const auto count = static_cast<double>(chunk.frames.size());
      sums.examples += count;
      if (!judge_.is_empty()) sums.labelled += count;
      add(chunk, &sums);
    }
    return sums;
  }

  void AddPictures(const Tensor& x1, const Tensor& x2, const Chunk& chunk, TrialSums* sums) {
    const Tensor goal1 = pictures_.Clean(chunk.goals1), goal2 = pictures_.Clean(chunk.goals2);
    sums->sum[kX1Error] += Errors(x1, goal1).sum().item<double>();
    sums->sum[kX2Error] += Errors(x2, goal2).sum().item<double>();
    sums->sum[kX1Psnr] += model::Psnr(x1, goal1).sum().item<double>();
    sums->sum[kX2Psnr] += model::Psnr(x2, goal2).sum().item<double>();
    sums->sum[kX1Ssim] += model::Ssim(x1, goal1).sum().item<double>();
    sums->sum[kX2Ssim] += model::Ssim(x2, goal2).sum().item<double>();
    sums->sum[kX1Label] += Hits(judge_, x1, chunk.action1);
    sums->sum[kX2Label] += Hits(judge_, x2, chunk.action2);
  }

  void AddPredictions(const Chunk& chunk, TrialSums* sums) {
    const Tensor x = pictures_.Seen(chunk.frames);
    const Tensor h = networks_.encoder->forward(x);
    const Tensor h0 = h0_.expand_as(h);
    const Tensor h1 = networks_.transform->forward(h0, h, chunk.action1);
    const Tensor h2 = networks_.transform->forward(h0, h1, chunk.action2);
    const Tensor decoded1 = networks_.decoder->forward(h1);
    const Tensor decoded2 = networks_.decoder->forward(h2);
    AddPictures((decoded1 * gain_).clamp(0, 1), (decoded2 * gain_).clamp(0, 1), chunk, sums);
    for (int64_t i = 0; i < x.size(0); ++i) {
      const auto at = static_cast<std::size_t>(i);
      if ((chunk.first + at) % kExtrasEvery != 0) continue;
      AddExtras(x.narrow(0, i, 1), h.narrow(0, i, 1), decoded1.narrow(0, i, 1),
                decoded2.narrow(0, i, 1), chunk, at, sums);
    }
  }

  void AddExtras(const Tensor& x, const Tensor& h, const Tensor& decoded1, const Tensor& decoded2,
                 const Chunk& chunk, std::size_t i, TrialSums* sums) {
    const Tensor start = networks_.decoder->forward(h);
    const auto error = [&](const Tensor& decoded, int64_t goal) {
      return Errors(model::ComposePicture(x, start, decoded), pictures_.Clean({goal}))
          .item<double>();
    };
    ++sums->extras;
    sums->sum[kX1Composed] += error(decoded1, chunk.goals1[i]);
    sums->sum[kX2Composed] += error(decoded2, chunk.goals2[i]);
    if (!networks_.has_classifier) return;
    ++sums->by_c;
    const Tensor action = chunk.action2.narrow(0, static_cast<int64_t>(i), 1);
    sums->sum[kX2LabelOfC] += Hits(networks_.classifier, (decoded2 * gain_).clamp(0, 1), action);
  }

  Tensor Reconstruct(int frame) {
    const Tensor x = pictures_.Seen({frame});
    const Tensor decoded = networks_.decoder->forward(networks_.encoder->forward(x));
    return (decoded * model::LightGain(x, decoded)).clamp(0, 1);
  }

  /// How a picture of a goal frame fares; many examples share one goal.
  struct Mark {
    double error = 0, psnr = 0, ssim = 0;
    int64_t label = -1;
  };
  Mark MarkOf(const Tensor& x, int frame) {
    const Tensor goal = pictures_.Clean({frame});
    Mark mark{Errors(x, goal).item<double>(), model::Psnr(x, goal).item<double>(),
              model::Ssim(x, goal).item<double>(), -1};
    if (judge_.is_empty()) return mark;
    model::Classifier reader = judge_;
    mark.label = reader->forward(x).argmax(1).item<int64_t>();
    return mark;
  }

  template <typename PictureFn>
  TrialSums SumOfGoals(const PictureFn& picture) {
    std::map<int, Mark> marks;
    const auto mark = [&](int frame) {
      const auto found = marks.find(frame);
      if (found != marks.end()) return found->second;
      return marks[frame] = MarkOf(picture(frame), frame);
    };
    TrialSums sums;
    for (const Example& e : ExamplesOf(pictures_.labels, data_.every, data_.paper_tail)) {
      const Mark one = mark(e.goal1), two = mark(e.goal2);
      ++sums.examples;
      if (!judge_.is_empty()) ++sums.labelled;
      sums.sum[kX1Error] += one.error;
      sums.sum[kX2Error] += two.error;
      sums.sum[kX1Psnr] += one.psnr;
      sums.sum[kX2Psnr] += two.psnr;
      sums.sum[kX1Ssim] += one.ssim;
      sums.sum[kX2Ssim] += two.ssim;
      sums.sum[kX1Label] += one.label == e.action1 ? 1 : 0;
      sums.sum[kX2Label] += two.label == e.action2 ? 1 : 0;
    }
    return sums;
  }

  const TableData& data_;
  model::Networks networks_;
  const model::Classifier& judge_;
  TrialPictures pictures_;
  Tensor h0_, gain_;
};

/// Numbers of the trials that are scored.
std::vector<std::size_t> TestTrials(const model::TrialFile& file, std::size_t most) {
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < file.size(); ++i) {
    if (file.part(i) == model::Split::kTest) all.push_back(i);
  }
  if (all.empty()) {
    throw model::DataError(file.path() + ": holds no test trials; add trials of other seeds");
  }
  if (most == 0 || all.size() <= most) return all;
  std::vector<std::size_t> chosen;
  for (std::size_t k = 0; k < most; ++k) chosen.push_back(all[k * all.size() / most]);
  return chosen;
}

using VisitFn = std::function<void(std::size_t number, TrialScorer* scorer, const model::Trial&)>;

/// Visits every test trial, several at a time.
void VisitTrials(const TableData& data, const model::Networks& networks,
                 const model::Classifier& judge, const ScoreProgress& progress,
                 const std::function<void(std::size_t)>& resize, const VisitFn& visit) {
  const model::TrialFile file(data.path);
  const std::vector<std::size_t> trials = TestTrials(file, data.trials);
  const int total = static_cast<int>(trials.size());
  resize(trials.size());
  std::mutex mutex;  // of the file (libhdf5 is not thread-safe) and of `done`
  int done = 0;
  model::ParallelPieces(total, 1, data.threads, [&](int64_t begin, int64_t) {
    const torch::NoGradGuard no_grad;
    const auto number = static_cast<std::size_t>(begin);
    std::unique_lock<std::mutex> lock(mutex);
    model::Trial trial = file.Read(trials[number]);
    lock.unlock();
    TrialPictures pictures = PicturesOf(std::move(trial));
    const model::Trial labels = pictures.labels;
    TrialScorer scorer(data, networks, judge, std::move(pictures));
    visit(number, &scorer, labels);
    lock.lock();
    progress(++done, total);
  });
}

Row::Trial RowTrial(const model::Trial& labels, const TrialSums& sums) {
  return {labels.seed, labels.succeeded(), sums};
}

}  // namespace

Row ScoreModel(const TableData& data, const model::Networks& networks,
               const model::Classifier& judge, const ScoreProgress& progress) {
  Row row;
  VisitTrials(
      data, networks, judge, progress, [&](std::size_t n) { row.trials.resize(n); },
      [&](std::size_t number, TrialScorer* scorer, const model::Trial& labels) {
        row.trials[number] = RowTrial(labels, scorer->OfModel());
      });
  return row;
}

Baselines ScoreBaselines(const TableData& data, const model::Networks& networks,
                         const model::Classifier& judge, const ScoreProgress& progress) {
  Baselines rows;
  const auto resize = [&](std::size_t n) {
    for (Row* row : {&rows.copy, &rows.reconstruction, &rows.goal}) row->trials.resize(n);
  };
  VisitTrials(data, networks, judge, progress, resize,
              [&](std::size_t number, TrialScorer* scorer, const model::Trial& labels) {
                rows.copy.trials[number] = RowTrial(labels, scorer->OfCopy());
                rows.reconstruction.trials[number] = RowTrial(labels, scorer->OfReconstruction());
                rows.goal.trials[number] = RowTrial(labels, scorer->OfGoals());
              });
  return rows;
}

}  // namespace prospect::tools
