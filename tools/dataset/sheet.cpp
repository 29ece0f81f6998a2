#include "tools/dataset/sheet.h"

#include <algorithm>
#include <filesystem>
#include <numeric>
#include <vector>

#include "base/random.h"
#include "report/contact_sheet.h"
#include "tools/dataset/action_table.h"

namespace prospect::tools {
namespace {

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

// A picture of the trial for each of `frames`, the action under each and the verdict under the
// last.
report::ContactSheet::Row RowOf(const model::TrialFile& file, std::size_t index,
                                const model::Trial& labels, const ActionTable& table) {
  const std::vector<int> frames = KeyFrames(labels);
  const std::size_t bytes = labels.frame_bytes();
  std::vector<std::uint8_t> pixels(frames.size() * bytes);
  file.ReadFrames(index, frames, pixels.data());
  report::ContactSheet::Row row{"scene " + std::to_string(labels.seed), {}};
  for (std::size_t k = 0; k < frames.size(); ++k) {
    const std::uint8_t* begin = pixels.data() + k * bytes;
    const bool last = k + 1 == frames.size();
    row.cells.push_back({{labels.width, labels.height, {begin, begin + bytes}},
                         !last ? table.Name(labels.actions[static_cast<std::size_t>(frames[k])])
                         : labels.succeeded() ? "success"
                                              : labels.reason});
  }
  return row;
}

std::string Title(const model::TrialFile& file, const std::string& task, std::size_t rows,
                  std::uint64_t seed) {
  return task + ": " + std::to_string(rows) + " of " + std::to_string(file.size()) + " trials of " +
         std::filesystem::path(file.path()).filename().string() + ", drawn with seed " +
         std::to_string(seed) + "; the first picture of each action, and the last";
}

}  // namespace

sim::Image ContactSheet(const model::TrialFile& file, const sim::TaskSpec* spec, std::size_t rows,
                        std::uint64_t seed) {
  if (file.size() == 0) throw model::DataError(file.path() + ": has no trials");
  const std::vector<std::size_t> chosen = DrawTrials(file.size(), rows, seed);
  const ActionTable table(spec);
  report::ContactSheet sheet;
  sheet.title = Title(file, file.ReadLabels(chosen.front()).task, chosen.size(), seed);
  for (const std::size_t index : chosen)
    sheet.rows.push_back(RowOf(file, index, file.ReadLabels(index), table));
  return report::Draw(sheet);
}

}  // namespace prospect::tools
