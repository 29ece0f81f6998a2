#pragma once

#include <string>
#include <vector>

/// What is said of a recorded trial's pictures: from which to which one each action ran. Read from
/// files beside the pictures (transcription.h, segment_csv.h), made labels of in trial_labels.h.
namespace prospect::model::segments {

/// The pictures during which one action ran. Frames count from 0.
struct Span {
  int first = 0, last = 0;
  int action = 0;
  bool succeeded = true;
  std::string cause;  ///< why it failed; empty: it did not, or nobody said
  int line = 0;       ///< of the file that says so
};

/// A trial's spans in order, each ending before the next begins; never empty.
struct Segmentation {
  std::vector<Span> spans;
  int used_from = 0;                 ///< the first frame of the trial; spans.front().first or less
  std::vector<std::string> repairs;  ///< what was put right, a line each, without the file's name

  int first() const { return spans.front().first; }
  int last() const { return spans.back().last; }
};

/// Spans as a file has them, in order. Repaired: rows out of order, and one that runs into the
/// next, which ends where that begins. Throws DataError (model/dataset.h) naming `path` and the
/// line: there are none, frames run backwards, or two begin together.
Segmentation InOrder(std::vector<Span> rows, const std::string& path);

/// Cuts what lies beyond the recording's `frames` frames; what was cut is a repair. Throws
/// DataError naming `path` if nothing is left.
void CutAtFrame(int frames, const std::string& path, Segmentation* segmentation);

/// The action that a file calls `word`: a name of the table, or its number. @return -1: neither,
/// and `*why` says so with the nearest name
int ActionOf(const std::string& word, const std::vector<std::string>& names, std::string* why);

/// Throws DataError "PATH: line N: WHAT".
[[noreturn]] void FailAtLine(const std::string& path, int line, const std::string& what);

}  // namespace prospect::model::segments
