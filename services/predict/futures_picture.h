#pragma once

#include <string>
#include <vector>

#include "agent/picture.h"

namespace prospect::services {

/// One imagined future: the actions that lead there, what it would look like, and, where it came
/// true while somebody waited, what the camera then saw.
struct ImaginedFuture {
  std::string words;
  agent::Picture imagined, truth;  ///< truth: empty where it is not known
};

/// What `predict` shows.
struct FuturesSheet {
  std::string title;
  agent::Picture seen;
  std::vector<ImaginedFuture> futures;
  std::string caption;
};

/// Writes the sheet as a PNG: what was seen, then each future, those with a truth beside it first.
/// Throws std::runtime_error.
void WriteFuturesSheet(const FuturesSheet& sheet, const std::string& path);

/// One picture as a PNG. Throws std::runtime_error.
void WritePicture(const agent::Picture& picture, const std::string& path);

/// Mean absolute difference as a share of full range, of pictures of one size.
double MeanAbsoluteError(const agent::Picture& a, const agent::Picture& b);

}  // namespace prospect::services
