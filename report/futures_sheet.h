#pragma once

#include <string>
#include <vector>

#include "sim/image.h"

namespace prospect::report {

/// One imagined future: the actions that lead there, what it would look like, and, where it came
/// true while somebody waited, what the camera then saw.
struct ImaginedFuture {
  std::string words;
  sim::Image imagined, truth;  ///< truth: empty where it is not known
};

/// What `predict` shows.
struct FuturesSheet {
  std::string title;
  sim::Image seen;
  std::vector<ImaginedFuture> futures;
  std::string caption;
};

/// Writes the sheet as a PNG: what was seen, then each future, those with a truth beside it first.
/// Throws base::DiskError.
void WriteFuturesSheet(const FuturesSheet& sheet, const std::string& path);

}  // namespace prospect::report
