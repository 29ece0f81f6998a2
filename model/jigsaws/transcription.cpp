#include "model/jigsaws/transcription.h"

#include <algorithm>
#include <fstream>
#include <sstream>

#include "model/dataset.h"
#include "model/jigsaws/gestures.h"

namespace prospect::model::jigsaws {
namespace {

constexpr int kMostFrames = 10'000'000;  // 90 hours; beyond it the number is damage
constexpr std::size_t kLongestLine = 200;

[[noreturn]] void Refuse(const std::string& path, int line, const std::string& what) {
  throw DataError(path + ": line " + std::to_string(line) + ": " + what);
}

GestureSpan ParseLine(const std::string& path, int number, const std::string& line) {
  std::istringstream in(line);
  GestureSpan span;
  std::string gesture, rest;
  if (line.size() > kLongestLine || !(in >> span.first >> span.last >> gesture) || in >> rest) {
    Refuse(path, number, "is not of the form 'FIRST LAST Gk'");
  }
  span.action = GestureAction(gesture);
  if (span.action < 0) {
    Refuse(path, number, "unknown gesture '" + gesture + "'; known are G1 to G15");
  }
  if (span.first < 1 || span.last < span.first || span.last > kMostFrames) {
    Refuse(path, number,
           "frames " + std::to_string(span.first) + " to " + std::to_string(span.last) +
               " are no stretch of a video");
  }
  return span;
}

void Append(const std::string& path, int number, const GestureSpan& span, Transcription* out) {
  if (!out->spans.empty()) {
    GestureSpan& before = out->spans.back();
    if (span.first <= before.first) {
      Refuse(path, number,
             "begins at frame " + std::to_string(span.first) + ", not after the gesture before it");
    }
    if (span.first <= before.last) {
      out->repairs.push_back("line " + std::to_string(number) +
                             ": overlaps the gesture before by " +
                             std::to_string(before.last - span.first + 1) +
                             " frames; that one ends where this begins");
      before.last = span.first - 1;
    }
  }
  out->spans.push_back(span);
}

}  // namespace

Transcription ReadTranscription(const std::string& path) {
  std::ifstream in(path);
  Transcription result;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    Append(path, number, ParseLine(path, number, line), &result);
  }
  if (in.bad() || !in.eof()) throw DataError(path + ": cannot be read");
  if (result.spans.empty()) throw DataError(path + ": holds no gesture");
  return result;
}

void CutAtFrame(int frames, const std::string& path, Transcription* transcription) {
  std::vector<GestureSpan>& spans = transcription->spans;
  if (spans.back().last <= frames) return;
  const int beyond = spans.back().last - frames;
  std::size_t dropped = 0;
  while (!spans.empty() && spans.back().first > frames) {
    spans.pop_back();
    ++dropped;
  }
  if (spans.empty()) throw DataError(path + ": the video ends before its first gesture");
  spans.back().last = std::min(spans.back().last, frames);
  std::string what = "goes " + std::to_string(beyond) + " frames beyond the video's " +
                     std::to_string(frames) + "; cut there";
  if (dropped > 0) what += ", " + std::to_string(dropped) + " gestures left out";
  transcription->repairs.push_back(what);
}

}  // namespace prospect::model::jigsaws
