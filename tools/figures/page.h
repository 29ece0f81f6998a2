#pragma once

#include <string>
#include <vector>

#include "tools/figures/sheet.h"

namespace prospect::figures {

inline constexpr int kMargin = 24;       ///< pixels around everything on a page
inline constexpr int kLeastWidth = 760;  ///< pixels of a page, so that its caption reads well

/// A finished figure.
struct Page {
  std::string file;     ///< "calibration.png"
  std::string caption;  ///< as it stands in the picture
  sim::Image picture;
};

/// Writes the heading. Returns the y below it.
int DrawHeading(Sheet* sheet, const std::string& title);

/// Writes the caption below what was drawn down to `y`, and cuts the sheet there.
Page Finish(Sheet* sheet, int y, const std::string& file, const std::string& caption);

/// Writes the picture into `folder`. Throws model::DiskError.
void WritePage(const std::string& folder, const Page& page);

/// Writes FOLDER/captions.md: `about` and then each file with its caption. Throws
/// model::DiskError.
void WriteCaptions(const std::string& folder, const std::string& about,
                   const std::vector<Page>& pages);

/// As printf would, for one number.
std::string Number(const char* format, double value);

}  // namespace prospect::figures
