#include "tools/figures/page.h"

#include <cstdio>
#include <fstream>

#include "model/dataset.h"
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
  try {
    sim::WritePng(folder + "/" + page.file, page.picture);
  } catch (const std::runtime_error& error) {
    throw model::DiskError(std::string(error.what()) + ": check the folder and the space left");
  }
}

void WriteCaptions(const std::string& folder, const std::string& about,
                   const std::vector<Page>& pages) {
  const std::string path = folder + "/captions.md";
  std::ofstream file(path);
  file << "# Figures\n\n" << about << "\n";
  for (const Page& page : pages) {
    file << "\n## " << page.file << "\n\n![" << page.file << "](" << page.file << ")\n\n"
         << page.caption << "\n";
  }
  file.close();
  if (!file) {
    throw model::DiskError(path + ": cannot be written; check the folder and the space left");
  }
}

std::string Number(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

}  // namespace prospect::figures
