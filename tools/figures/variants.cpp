#include "tools/figures/variants.h"

#include <algorithm>
#include <filesystem>
#include <set>

#include "base/number_format.h"
#include "base/text.h"
#include "model/training/variants.h"
#include "report/heat_map.h"
#include "report/image_edit.h"
#include "tools/figures/imagined.h"

namespace prospect::figures {

using namespace report;

namespace {

constexpr int kColumn = kSide + 14, kLabel = 40;
constexpr int kMostAcross = 10;   // columns on a page
constexpr int kRow = kSide + 24;  // a picture and its figure

// One column of one example: the pictures after the first and after the second action.
struct Pair {
  sim::Image x1, x2;
};

// Slots of what the chain starts from and of what its two actions led to.
struct Slots {
  std::size_t start, goal1, goal2;
};

Slots SlotsOf(const Chain& chain) {
  const auto k = static_cast<std::size_t>(chain.first);
  const auto& segments = chain.trial.segments();
  return {static_cast<std::size_t>(segments[k].start), static_cast<std::size_t>(segments[k].goal),
          static_cast<std::size_t>(segments[k + 1].goal)};
}

planner::Path ActionsOf(const Chain& chain) {
  const auto k = static_cast<std::size_t>(chain.first);
  const auto& segments = chain.trial.segments();
  return {static_cast<std::uint8_t>(segments[k].action),
          static_cast<std::uint8_t>(segments[k + 1].action)};
}

Pair Imagine(const Chain& chain, const LoadedModel& loaded) {
  const auto first = static_cast<std::size_t>(chain.trial.trial().first);
  const auto pictures = PicturesAlong(loaded, chain.trial.seen[first],
                                      chain.trial.seen[SlotsOf(chain).start], ActionsOf(chain));
  return {pictures[0], pictures[1]};
}

void DrawPrediction(Canvas* sheet, int x, int y, const sim::Image& picture,
                    const sim::Image& truth) {
  sheet->Picture(x, y, picture, FactorFor(std::max(picture.width, picture.height)));
  sheet->Centered(x + kSide / 2, y + kSide + 3,
                  "MAE " + base::Number("%.4f", MeanAbsoluteError(picture, truth)), kSmallStyle);
}

// What was seen and what is true. Returns the x of the first prediction.
int DrawTruth(Canvas* sheet, int x, int y, const Chain& chain) {
  const Slots slots = SlotsOf(chain);
  const auto& clean = chain.trial.clean;
  const int factor = FactorFor(std::max(clean[0].width, clean[0].height));
  sheet->Text(x, y + kSide / 2 - 10, "x1", kHeadStyle);
  sheet->Text(x, y + kRow + kSide / 2 - 10, "x2", kHeadStyle);
  x += kLabel;
  sheet->Picture(x, y, chain.trial.seen[slots.start], factor);
  x += kColumn;
  sheet->Picture(x, y, clean[slots.goal1], factor);
  sheet->Picture(x, y + kRow, clean[slots.goal2], factor);
  return x + kColumn;
}

std::string HeadingOf(const Chain& chain, const TaskTable& table) {
  const planner::Path actions = ActionsOf(chain);
  const auto k = static_cast<std::size_t>(chain.first);
  const auto& segments = chain.trial.segments();
  const auto word = [&](std::size_t i) {
    return table.Name(actions[i]) + (segments[k + i].succeeded ? "" : " (which fails here)");
  };
  return "Seed " + std::to_string(chain.trial.labels.seed) + ": action 1 " + word(0) +
         ", action 2 " + word(1);
}

// A model as a column of every example.
struct ColumnModel {
  std::string name;
  LoadedModel loaded;
};

int BlockWidth(const std::vector<ColumnModel>& models) {
  return kLabel + (2 + static_cast<int>(models.size())) * kColumn;
}

// The height of the tallest heading, so that examples beside each other stand in line.
int HeadingHeight(const std::vector<Chain>& chains, const TaskTable& table, int width) {
  int height = 0;
  for (const Chain& chain : chains) {
    Canvas scratch(width);
    height = std::max(height, scratch.Paragraph(0, 0, width, HeadingOf(chain, table), kHeadStyle));
  }
  return height;
}

// Below its heading. Returns the y below.
int DrawExample(Canvas* sheet, int x, int y, const Chain& chain,
                const std::vector<ColumnModel>& models) {
  const int middle = x + kLabel + kSide / 2;
  const int top = sheet->Centered(middle, y, "x", kBodyStyle) + 2;
  sheet->Centered(middle + kColumn, y, "truth", kBodyStyle);
  int left = DrawTruth(sheet, x, top, chain);
  const Slots slots = SlotsOf(chain);
  for (const ColumnModel& column : models) {
    const Pair pair = Imagine(chain, column.loaded);
    sheet->Centered(left + kSide / 2, y, column.name, kBodyStyle);
    DrawPrediction(sheet, left, top, pair.x1, chain.trial.clean[slots.goal1]);
    DrawPrediction(sheet, left, top + kRow, pair.x2, chain.trial.clean[slots.goal2]);
    left += kColumn;
  }
  return top + 2 * kRow + 12;
}

std::string Caption(const VariantSet& variants) {
  std::string caption =
      "Held-out examples, two rows each. x: what the camera saw when the first action began. "
      "Truth: the picture when each action had ended, without sensor noise. Then what each model "
      "imagines from x, as it is decoded, in the light of the trial's first picture: above after "
      "the first action (x1), below after both (x2), and under it the mean absolute error against "
      "the truth, as a share of full range.";
  if (!variants.absent.empty()) caption += " Not trained: " + base::Joined(variants.absent) + ".";
  return caption;
}

}  // namespace

VariantSet LoadVariants(const std::string& folder, const std::string& task, int threads) {
  VariantSet set;
  for (const model::Variant& variant : model::Variants()) {
    const std::string path = folder + "/" + variant.name + "/" + task + ".safetensors";
    if (!std::filesystem::exists(path)) {
      set.absent.push_back(variant.in_table);
      continue;
    }
    set.trained.push_back({variant.in_table, LoadWeights(path, threads)});
  }
  return set;
}

std::vector<Chain> ChooseChains(const HeldOut& held_out, const TaskTable& table, int count,
                                std::uint64_t seed) {
  std::vector<Chain> chains;
  std::set<std::string> kinds;
  int turn = 0;
  for (const std::size_t k : held_out.Shuffled(seed)) {
    if (static_cast<int>(chains.size()) == count) break;
    SeenTrial trial = held_out.Read(k);
    const auto& segments = trial.segments();
    if (segments.size() < 2) continue;
    // Each trial is entered somewhere else; its first action of a new kind is taken.
    const std::size_t places = segments.size() - 1;
    std::size_t chosen = static_cast<std::size_t>(turn++) * 2 % places;
    for (std::size_t i = 0; i < places; ++i) {
      const std::size_t at = (chosen + i) % places;
      if (kinds.contains(table.Name(segments[at].action))) continue;
      chosen = at;
      break;
    }
    kinds.insert(table.Name(segments[chosen].action));
    chains.push_back({std::move(trial), static_cast<int>(chosen)});
  }
  return chains;
}

Page DrawVariants(const std::vector<Chain>& chains, const TaskTable& table,
                  const VariantSet& variants, const LoadedModel& own, const std::string& own_name) {
  std::vector<ColumnModel> models;
  for (const VariantSet::Member& member : variants.trained) {
    models.push_back({member.name, member.loaded});
  }
  models.push_back({own_name, own});
  const int width = BlockWidth(models) + 10;
  const std::size_t across = std::max<std::size_t>(1, kMostAcross / (models.size() + 3));
  Canvas sheet(std::max(kLeastWidth, 2 * kMargin + static_cast<int>(across) * width));
  int y = DrawHeading(&sheet, "What the models imagine: " + own.engine->info().task);
  const int text = BlockWidth(models) - 10, height = HeadingHeight(chains, table, text);
  int below = y;
  for (std::size_t i = 0; i < chains.size(); ++i) {
    if (i % across == 0) y = below;
    const int x = kMargin + static_cast<int>(i % across) * width;
    sheet.Paragraph(x, y, text, HeadingOf(chains[i], table), kHeadStyle);
    below = std::max(below, DrawExample(&sheet, x, y + height + 4, chains[i], models));
  }
  return Finish(&sheet, below, "variants.png", Caption(variants));
}

}  // namespace prospect::figures
