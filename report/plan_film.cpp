#include "report/plan_film.h"

#include <cmath>

#include "report/people_view.h"
#include "report/video_writer.h"

namespace prospect::report {
namespace {

constexpr int kWidth = 640, kHeight = 480;

class Film : public sim::FrameSink {
 public:
  Film(sim::Task* task, const std::string& path)
      : task_(task),
        still_(static_cast<int>(std::lround(1 / task->spec().tick_seconds))),
        video_(path, 1 / task->spec().tick_seconds, kWidth, kHeight) {}

  void OnFrame(const sim::Image&, const sim::Progress&) override { Add(1); }
  void Pause() { Add(still_); }
  void Finish() { video_.Finish(); }

 private:
  void Add(int times) {
    const sim::Image picture = PeoplesView(*task_, "", kWidth, kHeight);
    for (int i = 0; i < times; ++i) video_.Add(picture);
  }

  sim::Task* task_;
  int still_;
  VideoWriter video_;
};

}  // namespace

sim::RolloutResult FilmPlan(sim::Task& task, std::uint64_t seed, const std::vector<int>& actions,
                            const std::string& path) {
  task.Reset(seed);
  Film film(&task, path);
  film.Pause();
  const sim::RolloutResult result = sim::RunPlan(task, actions, &film);
  film.Pause();
  film.Finish();
  return result;
}

}  // namespace prospect::report
