#include "model/recorded_trials.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>

#include "base/sensor_noise.h"
#include "model/weights_error.h"

namespace prospect::model {
namespace {

constexpr int kChanged = 26;  // of 255 in some channel: 0.1, as training's own scores have it

using Picture = std::vector<std::uint8_t>;

// Sums over pixels of one kind of imagined pictures.
struct ErrorSums {
  double all = 0, changed = 0, copied = 0, copied_changed = 0, values = 0, changed_values = 0;
  std::size_t pictures = 0;

  void Add(const Picture& imagined, const Picture& before, const Picture& truth) {
    for (std::size_t at = 0; at < truth.size(); at += 3) AddPixel(imagined, before, truth, at);
    ++pictures;
  }
  ImaginedError Mean() const {
    const double n = 255 * std::max(1.0, values), c = 255 * std::max(1.0, changed_values);
    return {all / n, changed / c, copied / n, copied_changed / c, pictures};
  }

 private:
  void AddPixel(const Picture& imagined, const Picture& before, const Picture& truth,
                std::size_t at) {
    int error = 0, copy = 0, most = 0;
    for (std::size_t i = at; i < at + 3; ++i) {
      const int moved = std::abs(before[i] - truth[i]);
      error += std::abs(imagined[i] - truth[i]);
      copy += moved;
      most = std::max(most, moved);
    }
    all += error;
    copied += copy;
    values += 3;
    if (most < kChanged) return;
    changed += error;
    copied_changed += copy;
    changed_values += 3;
  }
};

// One trial: the pictures between its actions, and what the networks make of them.
class Judge {
 public:
  Judge(Engine& engine, const Trial& trial, const GivenUpBelow& limits)
      : engine_(engine), trial_(trial), limits_(limits) {
    ends_.push_back(0);  // the frame before each action, and the last one of the trial
    for (int frame = 1; frame < trial.frames(); ++frame) {
      const int segment = trial.segment[static_cast<std::size_t>(frame)];
      if (segment > 0 && segment != trial.segment[static_cast<std::size_t>(frame - 1)])
        ends_.push_back(frame);
    }
    ends_.push_back(trial.frames() - 1);
    for (const int frame : ends_) pictures_.push_back(PictureOf(frame));
    for (const Picture& picture : pictures_) states_.push_back(engine_.Encode(picture));
  }

  RecordedTrial Plan() {
    RecordedTrial judged;
    judged.seed = trial_.seed;
    judged.succeeded = trial_.succeeded();
    judged.plan_length = trial_.plan_length;
    judged.first = TakeNoveltySample(engine_, pictures_.front());
    Hidden h = states_.front();
    Prediction last = engine_.Evaluate(states_.front(), h, trial_.num_actions);
    double score = 1;
    for (int k = 0; k < trial_.segments(); ++k) {
      const int action = ActionOf(k);
      judged.given_up |= last.p.at(static_cast<std::size_t>(action)) < limits_.possible;
      last = Imagine(h, action);
      h = last.h;
      judged.given_up |= last.done < limits_.done || last.value < limits_.value;
      score *= last.done;
      judged.steps.push_back({action, trial_.segment_succeeded[static_cast<std::size_t>(k)] == 1,
                              Imagine(states_[static_cast<std::size_t>(k)], action).done,
                              last.done});
    }
    judged.score = std::clamp(score * last.value, 0.0, 1.0);
    return judged;
  }

  void AddErrors(ErrorSums* one, ErrorSums* two) {
    for (int k = 0; k < trial_.segments(); ++k) {
      const auto at = static_cast<std::size_t>(k);
      const Hidden first = Imagine(states_[at], ActionOf(k)).h;
      one->Add(Paint(at, first), pictures_[at], pictures_[at + 1]);
      if (k + 1 == trial_.segments()) continue;
      const Hidden second = Imagine(first, ActionOf(k + 1)).h;
      two->Add(Paint(at, second), pictures_[at], pictures_[at + 2]);
    }
  }

 private:
  int ActionOf(int k) const {
    for (int frame = 0; frame < trial_.frames(); ++frame) {
      if (trial_.segment[static_cast<std::size_t>(frame)] == k)
        return trial_.actions[static_cast<std::size_t>(frame)];
    }
    throw DataError("trial " + std::to_string(trial_.seed) + ": no frame of its action " +
                    std::to_string(k + 1));
  }
  Picture PictureOf(int frame) const {
    const std::uint8_t* pixels = trial_.frame(frame);
    Picture picture(pixels, pixels + trial_.frame_bytes());
    base::AddSensorNoise(picture.data(), picture.size(), trial_.seed, frame, trial_.image_noise);
    return picture;
  }
  Prediction Imagine(const Hidden& h, int action) {
    return engine_.Expand({{states_.front(), h, action}}).front();
  }
  Picture Paint(std::size_t before, const Hidden& state) {
    return engine_.DecodeOnto(pictures_[before], states_[before], {state}).front();
  }

  Engine& engine_;
  const Trial& trial_;
  GivenUpBelow limits_;
  std::vector<int> ends_;
  std::vector<Picture> pictures_;
  std::vector<Hidden> states_;
};

void RequireFit(const EngineInfo& info, const TrialFile& file, const Trial& trial) {
  if (!info.judges) throw WeightsError(kPicturesOnly);
  if (info.task == trial.task && info.num_actions == trial.num_actions &&
      info.image_width == trial.width && info.image_height == trial.height)
    return;
  throw DataError(file.path() + ": holds trials of '" + trial.task + "' (" +
                  std::to_string(trial.num_actions) + " actions, " + std::to_string(trial.width) +
                  "x" + std::to_string(trial.height) + "), the weights were trained for '" +
                  info.task + "' (" + std::to_string(info.num_actions) + ", " +
                  std::to_string(info.image_width) + "x" + std::to_string(info.image_height) + ")");
}

}  // namespace

std::vector<std::size_t> HeldOutTrials(const TrialFile& file, bool all) {
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < file.size(); ++i) {
    if (!all && file.part(i) == Split::kTrain) continue;
    if (file.ReadLabels(i).segments() > 0) chosen.push_back(i);
  }
  return chosen;
}

RecordedTrials JudgeRecorded(Engine& engine, const TrialFile& file,
                             const std::vector<std::size_t>& trials, const GivenUpBelow& limits,
                             const std::function<void()>& progress) {
  RecordedTrials judged;
  ErrorSums one, two;
  for (const std::size_t i : trials) {
    const Trial trial = file.Read(i);
    RequireFit(engine.info(), file, trial);
    Judge judge(engine, trial, limits);
    judged.trials.push_back(judge.Plan());
    judge.AddErrors(&one, &two);
    if (progress) progress();
  }
  judged.after_one = one.Mean();
  judged.after_two = two.Mean();
  return judged;
}

}  // namespace prospect::model
