#include "tools/figures/futures.h"

#include <algorithm>

#include "base/number_format.h"
#include "report/heat_map.h"
#include "tools/evaluate/engine_model.h"
#include "tools/figures/cells.h"
#include "tools/figures/imagined.h"

namespace prospect::figures {

using namespace report;

namespace {

constexpr std::size_t kMostCourses = 8;

enum class Liking { kBest, kLeast };

// Of the actions that may come next and that p permits, the one that Q likes best or least; -1 if
// there is none.
int Next(const TaskTable& table, const planner::Path& path, const planner::Evaluation& state,
         Liking liking, double p_min) {
  int chosen = -1;
  for (const int action : table.Onward(path)) {
    const auto a = static_cast<std::size_t>(action);
    if (state.p[a] < p_min) continue;
    const auto c = static_cast<std::size_t>(chosen);
    const bool better =
        chosen < 0 || (liking == Liking::kBest ? state.q[a] > state.q[c] : state.q[a] < state.q[c]);
    if (better) chosen = action;
  }
  return chosen;
}

planner::Rejection Judge(const planner::Evaluation& state,
                         const planner::SearchParameters& parameters) {
  if (state.done < parameters.c_done) return planner::Rejection::kNotDone;
  if (state.value < parameters.v_failed) return planner::Rejection::kLowValue;
  return planner::Rejection::kNone;
}

Course Follow(const TaskTable& table, planner::ModelSource* model, int first, Liking liking,
              const planner::SearchParameters& parameters) {
  Course course;
  double done = 1;
  for (int action = first; action >= 0;) {
    course.path.push_back(static_cast<std::uint8_t>(action));
    course.states.push_back(model->Evaluate(course.path));
    const planner::Evaluation& state = course.states.back();
    done *= state.done;
    course.score = done * state.value;
    course.rejection = Judge(state, parameters);
    if (course.failed()) return course;
    action = Next(table, course.path, state, liking, parameters.p_min);
  }
  course.stuck = !table.rules.Complete({}, course.path);
  if (!course.stuck && course.score < parameters.refusal_threshold) {
    course.rejection = planner::Rejection::kLowScore;
  }
  return course;
}

bool Better(const Course& a, const Course& b) {
  if (a.failed() != b.failed()) return b.failed();
  if (a.path.size() != b.path.size()) return a.path.size() > b.path.size();
  return a.score > b.score;
}

bool Mixed(const std::vector<Course>& courses) {
  const auto failed = [](const Course& course) { return course.failed(); };
  return std::any_of(courses.begin(), courses.end(), failed) &&
         !std::all_of(courses.begin(), courses.end(), failed);
}

SceneFutures FuturesOf(const SeenTrial& trial, const TaskTable& table, model::Engine* engine,
                       const planner::SearchParameters& parameters) {
  SceneFutures scene;
  scene.seen = trial.seen[static_cast<std::size_t>(trial.trial().first)];
  scene.seed = trial.labels.seed;
  tools::EngineModel model(engine);
  model.SetFirst(scene.seen.rgb);
  model.SetRoot(scene.seen.rgb, table.rules.num_actions);
  scene.courses = ParallelCourses(TableFor(table, trial.labels), &model, parameters);
  return scene;
}

Strip StripOf(const Course& course, int number, const SceneFutures& scene, const TaskTable& table,
              const LoadedModel& loaded, const planner::SearchParameters& parameters) {
  const auto pictures = PicturesAlong(loaded, scene.seen, scene.seen, course.path);
  Strip strip;
  strip.heading = "Future " + std::to_string(number);
  strip.cells = CellsOf(table, course.path, course.states, pictures, parameters);
  strip.color = course.failed() ? kBad : kGood;
  if (course.stuck) {
    strip.verdict = base::Number("p permits nothing more (p < %.2f)", parameters.p_min);
  } else if (course.failed()) {
    strip.verdict = WhyRejected(course.rejection, static_cast<int>(course.path.size()),
                                course.states.back(), course.score, parameters);
  } else {
    strip.verdict = base::Number("may succeed: score %.2f", course.score);
  }
  if (course.failed()) strip.cells.back().bad = true;
  return strip;
}

std::string Caption(const SceneFutures& scene, const planner::SearchParameters& parameters) {
  return "Futures of one held-out scene (seed " + std::to_string(scene.seed) +
         "), side by side: for each first action that may be taken, how it goes on by what Q likes "
         "best and by what it likes least. All begin with the picture at the top; each picture "
         "after it is imagined, one action further, as it is decoded. V: probability that the task "
         "will succeed from "
         "there; f, where below 0.5: that the action got done. Red frame: the future fails there "
         "and is not followed further (" +
         base::Number("V < %.2f or ", parameters.v_failed) +
         base::Number("f < %.2f", parameters.c_done) +
         "), or its score at the end, V times f along the way, is below the refusal threshold of " +
         base::Number("%.2f", parameters.refusal_threshold) +
         ". The scene is the first in random order in which futures end both ways, if there is "
         "one.";
}

}  // namespace

std::vector<Course> ParallelCourses(const TaskTable& table, planner::ModelSource* model,
                                    const planner::SearchParameters& parameters) {
  std::vector<Course> courses;
  const planner::Evaluation root = model->Evaluate({});
  for (const int first : table.Onward({})) {
    if (root.p[static_cast<std::size_t>(first)] < parameters.p_min) continue;
    courses.push_back(Follow(table, model, first, Liking::kBest, parameters));
    Course least = Follow(table, model, first, Liking::kLeast, parameters);
    if (least.path != courses.back().path) courses.push_back(std::move(least));
  }
  std::stable_sort(courses.begin(), courses.end(), Better);
  return courses;
}

SceneFutures FindFutures(const HeldOut& held_out, const TaskTable& table, model::Engine* engine,
                         const planner::SearchParameters& parameters, int most,
                         std::uint64_t seed) {
  SceneFutures first;
  int looked_at = 0;
  for (const std::size_t k : held_out.Shuffled(seed)) {
    if (looked_at++ == most) break;
    SceneFutures scene = FuturesOf(held_out.Read(k), table, engine, parameters);
    if (Mixed(scene.courses)) return scene;
    if (looked_at == 1) first = std::move(scene);
  }
  return first;
}

Page DrawFutures(const SceneFutures& scene, const TaskTable& table, const LoadedModel& loaded,
                 const planner::SearchParameters& parameters) {
  std::vector<Strip> strips;
  for (const Course& course : scene.courses) {
    if (strips.size() == kMostCourses) break;
    const int number = static_cast<int>(strips.size()) + 1;
    strips.push_back(StripOf(course, number, scene, table, loaded, parameters));
  }
  Canvas sheet(std::max(kLeastWidth, StripsWidth(strips)));
  int y = DrawHeading(&sheet, "Parallel futures of one scene: " + loaded.engine->info().task);
  sheet.Picture(kMargin, y, scene.seen, FactorFor(std::max(scene.seen.width, scene.seen.height)));
  const int x = kMargin + kSide + 14;
  sheet.Paragraph(x, y, sheet.width() - x - kMargin,
                  "What the camera sees, and what the networks imagine for " +
                      std::to_string(strips.size()) + " plans that begin here.",
                  kBodyStyle);
  y = DrawStrips(&sheet, y + kSide + 14, strips);
  return Finish(&sheet, y, "futures.png", Caption(scene, parameters));
}

}  // namespace prospect::figures
