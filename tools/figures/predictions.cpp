#include "tools/figures/predictions.h"

#include <algorithm>
#include <map>
#include <set>

#include "base/number_format.h"
#include "base/random.h"
#include "report/heat_map.h"
#include "report/image_edit.h"
#include "tools/figures/imagined.h"

namespace prospect::figures {

using namespace report;

namespace {

constexpr int kGap = 14, kBetween = 14;
constexpr int kMostTurns = 1000;  // trials looked at for examples

/// Pictures are enlarged by whole factors to this width at least.
constexpr int kLeastPicture = 128;

int Factor(const sim::Image& picture) {
  return std::max(1, (kLeastPicture + picture.width - 1) / picture.width);
}

/// One row: what was seen, and for each action its name, what was imagined and what came.
struct Example {
  sim::Image seen;
  struct Step {
    std::string action;
    sim::Image imagined, truth;
  };
  std::vector<Step> steps;
  std::uint64_t seed = 0;
  std::string name;
};

Example ExampleOf(const Chain& chain, const TaskTable& table, const LoadedModel& own) {
  const auto& segments = chain.trial.segments();
  const auto k = static_cast<std::size_t>(chain.first);
  const auto first = static_cast<std::size_t>(chain.trial.trial().first);
  Example example;
  example.seen = chain.trial.seen[static_cast<std::size_t>(segments[k].start)];
  example.seed = chain.trial.labels.seed;
  example.name = chain.trial.labels.name;
  planner::Path path;
  for (std::size_t i = k; i < k + 2; ++i) {
    path.push_back(static_cast<std::uint8_t>(segments[i].action));
  }
  const auto imagined = PicturesAlong(own, chain.trial.seen[first], example.seen, path);
  for (std::size_t i = 0; i < 2; ++i) {
    const auto goal = static_cast<std::size_t>(segments[k + i].goal);
    example.steps.push_back({table.Name(path[i]), imagined[i], chain.trial.clean[goal]});
  }
  return example;
}

std::string Errors(const Example& example, std::size_t step) {
  const Example::Step& s = example.steps[step];
  return "MAE " + base::Number("%.4f", MeanAbsoluteError(s.imagined, s.truth)) + "; seen " +
         base::Number("%.4f", MeanAbsoluteError(example.seen, s.truth));
}

/// Returns the y below.
int DrawExample(Canvas* sheet, int y, const Example& example) {
  const int factor = Factor(example.seen);
  const int width = example.seen.width * factor, height = example.seen.height * factor;
  const std::string trial =
      example.name.empty() ? "seed " + std::to_string(example.seed) : example.name;
  int top = y, x = kMargin;
  top = std::max(top, sheet->Paragraph(x, y, width, trial + ": seen", kBodyStyle));
  for (std::size_t i = 0; i < example.steps.size(); ++i) {
    const int left = x + width + kGap + static_cast<int>(i) * (2 * width + kGap + kBetween);
    const std::string words = (i == 0 ? "imagined, then true: " : "and then: ");
    top = std::max(
        top, sheet->Paragraph(left, y, 2 * width, words + example.steps[i].action, kBodyStyle));
  }
  sheet->Picture(x, top, example.seen, factor);
  x += width + kGap;
  for (std::size_t i = 0; i < example.steps.size(); ++i) {
    sheet->Picture(x, top, example.steps[i].imagined, factor);
    sheet->Picture(x + width + 2, top, example.steps[i].truth, factor);
    sheet->Text(x, top + height + 3, Errors(example, i), kSmallStyle);
    x += 2 * width + kGap + kBetween;
  }
  return top + height + 3 + Canvas::LineHeight(kSmallStyle) + 8;
}

}  // namespace

std::vector<Chain> DrawnChains(const HeldOut& held_out, int count, std::uint64_t seed) {
  // Every other trial's places are tried before a trial comes again, new first actions before old.
  std::vector<Chain> chains;
  std::map<int, int> used;  // how often each first action was chosen
  std::set<std::pair<std::size_t, std::size_t>> taken;
  const std::vector<std::size_t> order = held_out.Shuffled(seed);
  base::Random random(seed);
  for (int turn = 0; turn < kMostTurns && static_cast<int>(chains.size()) < count; ++turn) {
    const std::size_t k = order[static_cast<std::size_t>(turn) % order.size()];
    SeenTrial trial = held_out.Read(k);
    const auto& segments = trial.segments();
    if (segments.size() < 2) continue;
    const auto places = static_cast<int>(segments.size()) - 1;
    const int from = random.Below(places);
    int best = -1;
    for (int i = 0; i < places; ++i) {
      const auto at = static_cast<std::size_t>((from + i) % places);
      if (taken.contains({k, at})) continue;
      if (best < 0 ||
          used[segments[at].action] < used[segments[static_cast<std::size_t>(best)].action]) {
        best = static_cast<int>(at);
      }
    }
    if (best < 0) continue;
    taken.insert({k, static_cast<std::size_t>(best)});
    ++used[segments[static_cast<std::size_t>(best)].action];
    chains.push_back({std::move(trial), best});
  }
  return chains;
}

Page DrawPredictions(const std::vector<Chain>& chains, const TaskTable& table,
                     const LoadedModel& own) {
  std::vector<Example> examples;
  for (const Chain& chain : chains) examples.push_back(ExampleOf(chain, table, own));
  const sim::Image& one = examples.front().seen;
  const int width = one.width * Factor(one);
  Canvas sheet(std::max(kLeastWidth, 2 * kMargin + 5 * width + 3 * kGap + 2 * kBetween));
  const std::string& world = chains.front().trial.labels.world_version;
  const bool simulated = world.find("simulated") != std::string::npos;
  int y = DrawHeading(&sheet, "What comes next: " + own.engine->info().task +
                                  (simulated ? ", simulated videos" : ""));
  for (const Example& example : examples) y = DrawExample(&sheet, y, example);
  return Finish(
      &sheet, y, "predictions.png",
      "Examples of held-out trials. Left: what the camera saw when an action began. Then, "
      "each time beside the picture that the camera really took: what the networks "
      "imagine from that one picture after the action and after the next one, in the "
      "light of the trial's first picture. MAE: mean absolute error as a share of full "
      "range; beside it that of showing again what was seen.");
}

Page DrawReconstructions(const std::vector<sim::Image>& pictures, const LoadedModel& own) {
  const int factor = Factor(pictures.front());
  const int width = pictures.front().width * factor, height = pictures.front().height * factor;
  const int count = static_cast<int>(pictures.size());
  Canvas sheet(std::max(kLeastWidth, 2 * kMargin + count * (width + kGap)));
  const int y = DrawHeading(&sheet, "What the encoder keeps: " + own.engine->info().task);
  int x = kMargin;
  for (const sim::Image& picture : pictures) {
    const model::Hidden h = own.engine->Encode(picture.rgb);
    const sim::Image again = own.paint(picture, h, {h}).front();
    sheet.Picture(x, y, picture, factor);
    sheet.Picture(x, y + height + 4, again, factor);
    sheet.Text(x, y + 2 * height + 7,
               "MAE " + base::Number("%.4f", MeanAbsoluteError(picture, again)), kSmallStyle);
    x += width + kGap;
  }
  return Finish(&sheet, y + 2 * height + 26, "reconstructions.png",
                "Pictures of held-out trials as they were seen (above) and decoded from their "
                "hidden states (below): all that a prediction could show. MAE: mean absolute "
                "error as a share of full range.");
}

std::vector<sim::Image> DrawnPictures(const HeldOut& held_out, int count, std::uint64_t seed) {
  base::Random random(seed);
  std::vector<sim::Image> pictures;
  const std::vector<std::size_t> order = held_out.Shuffled(seed);
  for (int i = 0; i < count; ++i) {
    const SeenTrial trial = held_out.Read(order[static_cast<std::size_t>(i) % order.size()]);
    const int chosen = random.Below(static_cast<int>(trial.seen.size()));
    pictures.push_back(trial.seen[static_cast<std::size_t>(chosen)]);
  }
  return pictures;
}

}  // namespace prospect::figures
