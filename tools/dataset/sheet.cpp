#include "tools/dataset/sheet.h"

#include <algorithm>
#include <filesystem>
#include <numeric>
#include <vector>

#include "base/random.h"
#include "sim/png.h"
#include "tools/dataset/action_table.h"
#include "tools/dataset/caption.h"

namespace prospect::tools {
namespace {

constexpr int kWidth = 128;   // a picture at least so wide, so that a name fits under it
constexpr int kGap = 4;       // pixels
constexpr int kCaption = 16;  // pixels
constexpr int kTitleWidth = 760, kMostWidth = 1900;

constexpr int kLine = 18;  // pixels, of the title and of the line above a row

// The first frame of each segment, and the last of all.
std::vector<int> KeyFrames(const model::Trial& trial) {
  std::vector<int> frames;
  int segment = -1;
  for (int i = 0; i < trial.frames(); ++i) {
    if (trial.segment[static_cast<std::size_t>(i)] == segment) continue;
    segment = trial.segment[static_cast<std::size_t>(i)];
    frames.push_back(i);
  }
  frames.push_back(trial.frames() - 1);
  return frames;
}

std::vector<std::size_t> DrawTrials(std::size_t count, std::size_t rows, std::uint64_t seed) {
  std::vector<std::size_t> all(count);
  std::iota(all.begin(), all.end(), std::size_t{0});
  base::Random random(seed);
  const std::size_t chosen = std::min(rows, count);
  for (std::size_t i = 0; i < chosen; ++i) {
    std::swap(all[i], all[i + static_cast<std::size_t>(random.Below(static_cast<int>(count - i)))]);
  }
  all.resize(chosen);
  return all;
}

struct Row {
  std::size_t index;
  model::Trial trial;  // labels only
  std::vector<int> frames;
};

sim::Image Picture(const model::Trial& trial, const std::uint8_t* pixels) {
  sim::Image image;
  image.width = trial.width;
  image.height = trial.height;
  image.rgb.assign(pixels, pixels + trial.frame_bytes());
  return sim::Enlarge(image, std::max(1, kWidth / trial.width));
}

std::string Words(const Row& row, const ActionTable& table, std::size_t k) {
  if (k + 1 < row.frames.size()) {
    return table.Name(row.trial.actions[static_cast<std::size_t>(row.frames[k])]);
  }
  return row.trial.succeeded() ? "success" : row.trial.reason;
}

std::string Title(const model::TrialFile& file, const std::string& task, std::size_t rows,
                  std::uint64_t seed) {
  return task + ": " + std::to_string(rows) + " of " + std::to_string(file.size()) + " trials of " +
         std::filesystem::path(file.path()).filename().string() + ", drawn with seed " +
         std::to_string(seed) + "; the first picture of each action, and the last";
}

// Where the pictures of a trial stand: side by side while the sheet fits a screen, then below.
struct Grid {
  int wide = 0, high = 0;  // a picture's place, pixels
  int columns = 1;

  Grid(const model::Trial& trial, std::size_t most) {
    const int factor = std::max(1, kWidth / trial.width);
    wide = trial.width * factor + kGap;
    high = trial.height * factor + kCaption + kGap;
    columns = std::clamp(kMostWidth / wide, 1, static_cast<int>(most));
  }
  int Width() const { return std::max(kTitleWidth, columns * wide); }
  int Height(const Row& row) const {
    const int pictures = static_cast<int>(row.frames.size());
    return kLine + (pictures + columns - 1) / columns * high;
  }
};

void DrawRow(const model::TrialFile& file, const Row& row, const ActionTable& table,
             const Grid& grid, int top, sim::Image* sheet) {
  DrawCaption("scene " + std::to_string(row.trial.seed), 2, top + 2, sheet);
  top += kLine;
  std::vector<std::uint8_t> pixels(row.frames.size() * row.trial.frame_bytes());
  file.ReadFrames(row.index, row.frames, pixels.data());
  for (std::size_t k = 0; k < row.frames.size(); ++k) {
    const sim::Image picture = Picture(row.trial, pixels.data() + k * row.trial.frame_bytes());
    const int x = static_cast<int>(k) % grid.columns * grid.wide;
    const int y = top + static_cast<int>(k) / grid.columns * grid.high;
    sim::Paste(picture, x, y, sheet);
    DrawCaption(Words(row, table, k), x + 2, y + picture.height + 2, sheet);
  }
}

}  // namespace

sim::Image ContactSheet(const model::TrialFile& file, std::size_t rows, std::uint64_t seed) {
  if (file.size() == 0) throw model::DataError(file.path() + ": has no trials");
  std::vector<Row> chosen;
  std::size_t columns = 0;
  for (const std::size_t index : DrawTrials(file.size(), rows, seed)) {
    Row row{index, file.ReadLabels(index), {}};
    row.frames = KeyFrames(row.trial);
    columns = std::max(columns, row.frames.size());
    chosen.push_back(std::move(row));
  }
  const model::Trial& first = chosen.front().trial;
  const Grid grid(first, columns);
  sim::Image sheet;
  sheet.width = grid.Width();
  sheet.height = kLine;
  for (const Row& row : chosen) sheet.height += grid.Height(row);
  sheet.rgb.assign(static_cast<std::size_t>(sheet.width) * sheet.height * 3, 255);
  const ActionTable table(first);
  DrawCaption(Title(file, first.task, chosen.size(), seed), 2, 2, &sheet);
  int top = kLine;
  for (const Row& row : chosen) {
    DrawRow(file, row, table, grid, top, &sheet);
    top += grid.Height(row);
  }
  return sheet;
}

}  // namespace prospect::tools
