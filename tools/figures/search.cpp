#include "tools/figures/search.h"

#include <algorithm>
#include <set>

#include "base/number_format.h"
#include "report/heat_map.h"
#include "tools/evaluate/engine_model.h"
#include "tools/figures/cells.h"
#include "tools/figures/imagined.h"

namespace prospect::figures {

using namespace report;

namespace {

constexpr int kMostTried = 6;

std::set<Fate> FatesIn(const SearchStory& story) {
  std::set<Fate> fates;
  for (const Tried& tried : story.tried) fates.insert(tried.fate);
  return fates;
}

bool TellsEnough(const SearchStory& story) {
  const std::set<Fate> fates = FatesIn(story);
  return story.plan.ok() && std::count_if(fates.begin(), fates.end(), IsRejection) >= 2;
}

SceneSearch SearchScene(const SeenTrial& trial, const TaskTable& table, model::Engine* engine,
                        const planner::SearchParameters& parameters) {
  SceneSearch scene;
  scene.seen = trial.seen[static_cast<std::size_t>(trial.trial().first)];
  scene.seed = trial.labels.seed;
  tools::EngineModel model(engine);
  model.SetFirst(scene.seen.rgb);
  model.SetRoot(scene.seen.rgb, table.rules.num_actions);
  scene.story = WatchSearch(TableFor(table, trial.labels), parameters, &model);
  return scene;
}

Color ColorOf(Fate fate) {
  if (fate == Fate::kChosen) return kGood;
  return IsRejection(fate) ? kBad : kInk;
}

Strip StripOf(const Tried& tried, const SceneSearch& scene, const TaskTable& table,
              const LoadedModel& loaded, const planner::SearchParameters& parameters) {
  Strip strip;
  strip.heading = (tried.fate == Fate::kChosen ? "Chosen: future no. " : "Future no. ") +
                  std::to_string(tried.number);
  strip.cells = CellsOf(table, tried.path, tried.states,
                        PicturesAlong(loaded, scene.seen, scene.seen, tried.path), parameters);
  if (IsRejection(tried.fate)) strip.cells.back().bad = true;
  strip.verdict = Verdict(tried, scene.story, parameters);
  strip.color = ColorOf(tried.fate);
  return strip;
}

// First actions that p excluded: never imagined.
std::string RuledOut(const SearchStory& story, const TaskTable& table) {
  std::string names;
  for (const planner::Future& future : story.plan.rejected) {
    if (future.rejection != planner::Rejection::kNotPermitted || future.path.size() != 1) continue;
    names += (names.empty() ? "" : ", ") + table.Name(future.path.front()) +
             base::Number(" (p %.3f)", future.steps.back().prior);
  }
  return names;
}

std::string Tally(const SearchStory& story) {
  const planner::Plan& plan = story.plan;
  return "Complete futures: " + std::to_string(plan.complete_futures) + ", after " +
         std::to_string(story.rollouts) + " rollouts. Rejected: " + std::to_string(plan.not_done) +
         " because an action would not finish (f), " + std::to_string(plan.low_value) +
         " because V fell too low, " + std::to_string(plan.low_score) +
         " for the score at their end, and " + std::to_string(plan.not_permitted) +
         " continuations, never imagined, that p forbids.";
}

// What the camera sees, and beside it how the search ended. Returns the y below.
int DrawTop(Canvas* sheet, int y, const SceneSearch& scene, const TaskTable& table) {
  sheet->Picture(kMargin, y, scene.seen, FactorFor(std::max(scene.seen.width, scene.seen.height)));
  const int x = kMargin + kSide + 14, width = sheet->width() - x - kMargin;
  int below =
      sheet->Paragraph(x, y, width, "What the camera sees. " + Tally(scene.story), kBodyStyle);
  if (!scene.story.plan.ok()) {
    below = sheet->Paragraph(x, below + 4, width, "Refused: " + scene.story.plan.reason,
                             {kBodyStyle.size, kBad, false});
  }
  const std::string ruled_out = RuledOut(scene.story, table);
  if (!ruled_out.empty()) {
    below = sheet->Paragraph(x, below + 4, width, "Forbidden by p as first action: " + ruled_out,
                             {kBodyStyle.size, kBad, false});
  }
  return std::max(below, y + kSide) + 12;
}

std::string Caption(const SceneSearch& scene, const planner::SearchParameters& parameters) {
  return "One search over the futures of a held-out scene (seed " + std::to_string(scene.seed) +
         ", " + std::to_string(parameters.samples) +
         " samples): the plan that it chose, and other futures, numbered as they were imagined: "
         "the "
         "first of each way to end, and the first ones. Under each imagined picture, as it is "
         "decoded, V, the "
         "probability that the task will succeed from there, and, where below 0.5, f, the "
         "probability that the action got done. Red: the future was given up there. A plan's score "
         "is V at its end times f along the way. The scene is the first in random order whose "
         "search found a plan and rejected futures for two reasons or more, if there is one.";
}

}  // namespace

SceneSearch FindSearch(const HeldOut& held_out, const TaskTable& table, model::Engine* engine,
                       const planner::SearchParameters& parameters, int most, std::uint64_t seed) {
  SceneSearch best;
  int looked_at = 0;
  for (const std::size_t k : held_out.Shuffled(seed)) {
    if (looked_at++ == most) break;
    SceneSearch scene = SearchScene(held_out.Read(k), table, engine, parameters);
    if (TellsEnough(scene.story)) return scene;
    if (looked_at == 1 || FatesIn(scene.story).size() > FatesIn(best.story).size()) {
      best = std::move(scene);
    }
  }
  return best;
}

Page DrawSearch(const SceneSearch& scene, const TaskTable& table, const LoadedModel& loaded,
                const planner::SearchParameters& parameters) {
  const std::vector<Tried> shown = ChooseTried(scene.story, kMostTried);
  std::vector<Strip> strips;
  for (const Tried& tried : shown) {
    strips.push_back(StripOf(tried, scene, table, loaded, parameters));
  }
  Canvas sheet(std::max(kLeastWidth, StripsWidth(strips)));
  int y = DrawHeading(&sheet, "One search, and what it rejected: " + loaded.engine->info().task);
  y = DrawStrips(&sheet, DrawTop(&sheet, y, scene, table), strips);
  return Finish(&sheet, y, "search.png", Caption(scene, parameters));
}

}  // namespace prospect::figures
