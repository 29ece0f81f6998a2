#include "tools/collect/gesture_trial.h"

#include <cmath>

#include "base/random.h"
#include "sim/suturing/gestures.h"

namespace prospect::tools {
namespace {

constexpr std::uint64_t kChoiceStream = 0x6765737475ULL;
constexpr std::uint64_t kAttemptStream = 0x617474656dULL;
constexpr double kWait = 1.0;  // s before the first gesture and after the last

// Counts frames and shows them.
class Player {
 public:
  Player(sim::SuturingTask* task, const std::function<void(int)>& on_frame)
      : task_(task), on_frame_(on_frame) {}

  void Show() {
    ++frames_;
    if (on_frame_) on_frame_(frames_);
  }
  void Tick() {
    task_->Tick();
    Show();
  }
  void Wait(double seconds) {
    const auto ticks = std::lround(seconds / task_->spec().tick_seconds);
    for (long i = 0; i < ticks; ++i) Tick();
  }
  int frames() const { return frames_; }

 private:
  sim::SuturingTask* task_;
  const std::function<void(int)>& on_frame_;
  int frames_ = 0;
};

}  // namespace

GestureTrial PlayGestureTrial(sim::SuturingTask* task, std::uint64_t seed, int attempt,
                              const std::function<void(int)>& on_frame) {
  const auto try_number = static_cast<std::uint64_t>(attempt);
  task->Reset(seed);
  if (attempt > 0) task->SetNoiseSeed(base::MixSeeds({seed, kAttemptStream, try_number}));
  base::Random choices(base::MixSeeds({seed, kChoiceStream, try_number}));
  GestureTrial trial;
  Player player(task, on_frame);
  player.Show();
  player.Wait(choices.Uniform(0.5, 1.5) * kWait);
  for (std::vector<int> legal = task->LegalActions(); !legal.empty();
       legal = task->LegalActions()) {
    const int last = trial.spans.empty() ? sim::kGestures : trial.spans.back().gesture;
    const int gesture = sim::ChooseGesture(last, legal, task->AllThrown(), &choices);
    const int first = player.frames() + 1;
    task->StartAction(gesture);
    while (task->progress().action_state == sim::ActionState::kRunning) player.Tick();
    trial.spans.push_back({first, player.frames(), gesture});
  }
  player.Wait(kWait);
  trial.frames = player.frames();
  trial.reason = task->progress().reason;
  return trial;
}

std::string TranscriptionText(const GestureTrial& trial) {
  std::string text;
  for (const GestureSpan& span : trial.spans) {
    text += std::to_string(span.first) + ' ' + std::to_string(span.last) + " G" +
            std::to_string(span.gesture + 1) + " \n";
  }
  return text;
}

}  // namespace prospect::tools
