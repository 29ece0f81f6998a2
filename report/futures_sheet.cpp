#include "report/futures_sheet.h"

#include <algorithm>

#include "base/number_format.h"
#include "report/canvas.h"
#include "report/image_edit.h"
#include "report/page.h"
#include "report/png.h"

namespace prospect::report {
namespace {

constexpr int kPicture = 256, kGap = 16, kAcross = 5;
constexpr Color kSeen = kInk, kImagined = kMark, kTrue = kGood;

int HeightOf(const sim::Image& picture) {
  return picture.empty() ? kPicture : kPicture * picture.height / std::max(1, picture.width);
}

std::string ErrorText(const FuturesSheet& sheet, const ImaginedFuture& future) {
  return base::Number("MAE %.4f; ", MeanAbsoluteError(future.imagined, future.truth)) +
         base::Number("what was seen %.4f", MeanAbsoluteError(sheet.seen, future.truth));
}

std::string WordsOf(const ImaginedFuture& future) {
  return future.truth.empty() ? future.words : "imagined: " + future.words;
}

/// Room for the words above a picture: what the longest of them takes.
int WordsHeight(const FuturesSheet& sheet) {
  Canvas scratch(kPicture);
  int height = 0;
  for (const ImaginedFuture& future : sheet.futures)
    height = std::max(height, scratch.Paragraph(0, 0, kPicture, WordsOf(future), {}));
  return height;
}

/// Places pictures from left to right and line after line.
class Grid {
 public:
  Grid(Canvas* canvas, int top, int words, int height)
      : canvas_(*canvas), top_(top), words_(words), height_(height) {}

  void Put(const std::string& words, const std::string& below, const sim::Image& picture,
           const Color& color) {
    if (column_ == kAcross) NewLine();
    const int x = kMargin + column_++ * (kPicture + kGap);
    canvas_.Paragraph(x, top_, kPicture, words, {});
    canvas_.Framed(x, top_ + words_, kPicture, picture, color);
    canvas_.Text(x, top_ + words_ + height_ + 4, below, {0.38, kFaint, false});
  }
  /// The next `count` pictures stand in one line.
  void Keep(int count) {
    if (column_ + count > kAcross) NewLine();
  }
  int Bottom() const { return top_ + words_ + height_ + kBelow; }

 private:
  static constexpr int kBelow = 28;
  void NewLine() {
    top_ = Bottom();
    column_ = 0;
  }
  Canvas& canvas_;
  int top_, words_, height_;
  int column_ = 0;
};

}  // namespace

void WriteFuturesSheet(const FuturesSheet& sheet, const std::string& path) {
  Canvas canvas(2 * kMargin + kAcross * kPicture + (kAcross - 1) * kGap);
  const int top = canvas.Text(kMargin, kMargin, sheet.title, kTitleStyle);
  Grid grid(&canvas, top + 8, WordsHeight(sheet) + 4, HeightOf(sheet.seen));
  grid.Put("seen", "", sheet.seen, kSeen);
  for (const ImaginedFuture& future : sheet.futures) {
    if (future.truth.empty()) continue;
    grid.Keep(2);
    grid.Put(WordsOf(future), ErrorText(sheet, future), future.imagined, kImagined);
    grid.Put("what then came", "", future.truth, kTrue);
  }
  for (const ImaginedFuture& future : sheet.futures) {
    if (future.truth.empty()) grid.Put(WordsOf(future), "", future.imagined, kImagined);
  }
  const int bottom =
      canvas.Paragraph(kMargin, grid.Bottom(), canvas.width() - 2 * kMargin, sheet.caption, {});
  WritePng(path, canvas.Cut(bottom + kMargin / 2));
}

}  // namespace prospect::report
