#include "report/page.h"

#include <sstream>

#include "base/atomic_file.h"
#include "report/png.h"

namespace prospect::report {

int DrawHeading(Canvas* canvas, const std::string& title) {
  return canvas->Paragraph(kMargin, kMargin - 6, canvas->width() - 2 * kMargin, title,
                           kTitleStyle) +
         8;
}

sim::Image Captioned(Canvas* canvas, int y, const std::string& caption) {
  const int width = canvas->width() - 2 * kMargin;
  canvas->Line(kMargin, y + 6, kMargin + width, y + 6, kRule, 1);
  const int below = canvas->Paragraph(kMargin, y + 14, width, caption, kBodyStyle);
  return canvas->Cut(below + kMargin / 2);
}

Page Finish(Canvas* canvas, int y, const std::string& file, const std::string& caption) {
  return {file, caption, Captioned(canvas, y, caption)};
}

void WritePage(const std::string& folder, const Page& page) {
  WritePng(folder + "/" + page.file, page.picture);
}

void WriteCaptions(const std::string& folder, const std::string& about,
                   const std::vector<Page>& pages) {
  std::ostringstream file;
  file << "# Figures\n\n" << about << "\n";
  for (const Page& page : pages) {
    file << "\n## " << page.file << "\n\n![" << page.file << "](" << page.file << ")\n\n"
         << page.caption << "\n";
  }
  base::WriteFile(folder + "/captions.md", file.str());
}

}  // namespace prospect::report
