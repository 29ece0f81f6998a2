#include "tools/figures/page.h"

#include <cstdio>
#include <sstream>

#include "base/atomic_file.h"
#include "sim/png.h"

namespace prospect::figures {

int DrawHeading(Sheet* sheet, const std::string& title) {
  return sheet->Paragraph(kMargin, kMargin - 6, sheet->width() - 2 * kMargin, title, kTitleStyle) +
         8;
}

Page Finish(Sheet* sheet, int y, const std::string& file, const std::string& caption) {
  sheet->Line(kMargin, y + 6, sheet->width() - kMargin, y + 6, kRule, 1);
  const int below =
      sheet->Paragraph(kMargin, y + 14, sheet->width() - 2 * kMargin, caption, kBodyStyle);
  return {file, caption, sheet->Cut(below + kMargin / 2)};
}

void WritePage(const std::string& folder, const Page& page) {
  sim::WritePng(folder + "/" + page.file, page.picture);
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

std::string Number(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

}  // namespace prospect::figures
