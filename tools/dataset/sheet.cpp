#include "tools/dataset/sheet.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include "sim/png.h"
#include "sim/random.h"
#include "tools/dataset/action_table.h"
#include "tools/dataset/caption.h"

namespace prospect::tools {
namespace {

constexpr int kWidth = 128;   // a picture at least so wide, so that a name fits under it
constexpr int kGap = 4;       // pixels
constexpr int kCaption = 16;  // pixels

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
  sim::Random random(seed);
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

void DrawRow(const model::TrialFile& file, const Row& row, const ActionTable& table, int top,
             sim::Image* sheet) {
  std::vector<std::uint8_t> pixels(row.frames.size() * row.trial.frame_bytes());
  file.ReadFrames(row.index, row.frames, pixels.data());
  int left = 0;
  for (std::size_t k = 0; k < row.frames.size(); ++k) {
    const sim::Image picture = Picture(row.trial, pixels.data() + k * row.trial.frame_bytes());
    sim::Paste(picture, left, top, sheet);
    DrawCaption(Words(row, table, k), left + 2, top + picture.height + 2, sheet);
    left += picture.width + kGap;
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
  const int factor = std::max(1, kWidth / first.width);
  const int step = first.height * factor + kCaption + kGap;
  sim::Image sheet;
  sheet.width = static_cast<int>(columns) * (first.width * factor + kGap);
  sheet.height = static_cast<int>(chosen.size()) * step;
  sheet.rgb.assign(static_cast<std::size_t>(sheet.width) * sheet.height * 3, 255);
  const ActionTable table(first);
  int top = 0;
  for (const Row& row : chosen) {
    DrawRow(file, row, table, top, &sheet);
    top += step;
  }
  return sheet;
}

}  // namespace prospect::tools
