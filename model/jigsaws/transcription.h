#pragma once

#include <string>
#include <vector>

namespace prospect::model::jigsaws {

/// One labelled stretch of a video. Frames count from 1, as the transcriptions do.
struct GestureSpan {
  int first = 0, last = 0;
  int action = 0;  ///< 0..kGestures-1
};

/// A transcription as it is used: spans in order, each ending before the next begins.
struct Transcription {
  std::vector<GestureSpan> spans;
  std::vector<std::string> repairs;  ///< what was put right, a line each, without the file's name

  int first() const { return spans.front().first; }
  int last() const { return spans.back().last; }
};

/// Reads a transcription: a line "FIRST LAST Gk" a gesture, empty lines allowed. Repaired: a
/// gesture that runs into the next one ends where that begins. Throws DataError (model/dataset.h),
/// naming file and line, on a file that cannot be read or is empty, a line of another form, frames
/// that run backwards, gestures out of order, and gestures other than G1 to G15.
Transcription ReadTranscription(const std::string& path);

/// Cuts what lies beyond the video's `frames` frames; what was cut is a repair. Throws DataError
/// naming `path` if nothing is left.
void CutAtFrame(int frames, const std::string& path, Transcription* transcription);

}  // namespace prospect::model::jigsaws
