#pragma once

#include <string>
#include <vector>

#include "report/canvas.h"

namespace prospect::report {

inline constexpr int kMargin = 24;       ///< pixels around everything on a page
inline constexpr int kLeastWidth = 760;  ///< pixels of a page, so that its caption reads well

/// A finished figure.
struct Page {
  std::string file;     ///< "calibration.png"
  std::string caption;  ///< as it stands in the picture
  sim::Image picture;
};

/// Writes the heading. Returns the y below it.
int DrawHeading(Canvas* canvas, const std::string& title);

/// What was drawn down to `y`, with the caption below it.
sim::Image Captioned(Canvas* canvas, int y, const std::string& caption);

/// The same as a page.
Page Finish(Canvas* canvas, int y, const std::string& file, const std::string& caption);

/// Writes the picture into `folder`. Throws base::DiskError.
void WritePage(const std::string& folder, const Page& page);

/// Writes FOLDER/captions.md: `about` and then each file with its caption. Throws
/// base::DiskError.
void WriteCaptions(const std::string& folder, const std::string& about,
                   const std::vector<Page>& pages);

}  // namespace prospect::report
