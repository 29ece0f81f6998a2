#include "model/segments/segmentation.h"

#include <algorithm>
#include <charconv>

#include "base/nearest.h"
#include "model/dataset.h"

namespace prospect::model::segments {
namespace {

constexpr int kMostFrames = 10'000'000;  // 90 hours; beyond it the number is damage
constexpr std::size_t kShownLetters = 40;

std::string LineText(int line) { return "line " + std::to_string(line); }

std::string FramesText(int count) {
  return std::to_string(count) + (count == 1 ? " frame" : " frames");
}

void RequireStretch(const Span& row, const std::string& path) {
  if (row.first >= 0 && row.last >= row.first && row.last <= kMostFrames) return;
  FailAtLine(path, row.line, "ends before it begins, or is no stretch of a recording");
}

void SortByBegin(Segmentation* result) {
  std::vector<Span>& spans = result->spans;
  const auto earlier = [](const Span& a, const Span& b) { return a.first < b.first; };
  for (std::size_t i = 1; i < spans.size(); ++i) {
    if (earlier(spans[i], spans[i - 1]))
      result->repairs.push_back(LineText(spans[i].line) +
                                ": begins before the row above it; sorted by their beginnings");
  }
  std::stable_sort(spans.begin(), spans.end(), earlier);
}

void CutOverlap(const std::string& path, const Span& next, Span* before,
                std::vector<std::string>* repairs) {
  if (next.first == before->first)
    FailAtLine(path, next.line, "begins together with " + LineText(before->line));
  if (next.first > before->last) return;
  repairs->push_back(LineText(next.line) + ": overlaps the action before by " +
                     FramesText(before->last - next.first + 1) +
                     "; that one ends where this begins");
  before->last = next.first - 1;
}

// Texts of files may hold anything.
std::string Shown(const std::string& word) {
  std::string text = word.substr(0, kShownLetters);
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return "'" + text + "'";
}

}  // namespace

void FailAtLine(const std::string& path, int line, const std::string& what) {
  throw DataError(path + ": " + LineText(line) + ": " + what);
}

Segmentation InOrder(std::vector<Span> rows, const std::string& path) {
  if (rows.empty()) throw DataError(path + ": holds no action");
  Segmentation result;
  result.spans = std::move(rows);
  for (const Span& row : result.spans) RequireStretch(row, path);
  SortByBegin(&result);
  for (std::size_t i = 1; i < result.spans.size(); ++i)
    CutOverlap(path, result.spans[i], &result.spans[i - 1], &result.repairs);
  result.used_from = result.first();
  return result;
}

void CutAtFrame(int frames, const std::string& path, Segmentation* segmentation) {
  std::vector<Span>& spans = segmentation->spans;
  if (spans.back().last < frames) return;
  const int beyond = spans.back().last - frames + 1;
  const auto later = std::find_if(spans.begin(), spans.end(),
                                  [frames](const Span& span) { return span.first >= frames; });
  const auto dropped = spans.end() - later;
  spans.erase(later, spans.end());
  if (spans.empty()) throw DataError(path + ": the recording ends before its first action");
  spans.back().last = std::min(spans.back().last, frames - 1);
  std::string what = "goes " + FramesText(beyond) + " beyond the recording's " +
                     std::to_string(frames) + "; cut there";
  if (dropped > 0) what += ", actions left out: " + std::to_string(dropped);
  segmentation->repairs.push_back(what);
}

int ActionOf(const std::string& word, const std::vector<std::string>& names, std::string* why) {
  const auto named = std::find(names.begin(), names.end(), word);
  if (named != names.end()) return static_cast<int>(named - names.begin());
  int number = -1;
  const char* end = word.data() + word.size();
  const auto [rest, error] = std::from_chars(word.data(), end, number);
  const int most = static_cast<int>(names.size()) - 1;
  if (!word.empty() && error == std::errc() && rest == end && number >= 0 && number <= most)
    return number;
  const std::string nearest = base::NearestWord(word, names);
  *why =
      "there is no action " + Shown(word) +
      (nearest.empty() ? "; give a name of the task, or a number from 0 to " + std::to_string(most)
                       : "; did you mean '" + nearest + "'?");
  return -1;
}

}  // namespace prospect::model::segments
