#include "services/predict/futures_picture.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "base/atomic_file.h"
#include "services/executive/canvas.h"

namespace prospect::services {
namespace {

constexpr int kSide = 256, kGap = 16, kMargin = 20, kAcross = 5;
const cv::Scalar kSeen(60, 60, 60), kImagined(190, 120, 40), kTrue(60, 140, 40);

int HeightOf(const agent::Picture& picture) {
  return picture.empty() ? kSide : kSide * picture.height / std::max(1, picture.width);
}

std::string ErrorText(const FuturesSheet& sheet, const ImaginedFuture& future) {
  char text[96];
  std::snprintf(text, sizeof text, "MAE %.4f; what was seen %.4f",
                MeanAbsoluteError(future.imagined, future.truth),
                MeanAbsoluteError(sheet.seen, future.truth));
  return text;
}

std::string WordsOf(const ImaginedFuture& future) {
  return future.truth.empty() ? future.words : "imagined: " + future.words;
}

/// Room for the words above a picture: what the longest of them takes.
int WordsHeight(const FuturesSheet& sheet) {
  Canvas scratch(kSide);
  int height = 0;
  for (const ImaginedFuture& future : sheet.futures)
    height = std::max(height, scratch.Paragraph(0, 0, kSide, WordsOf(future), {}));
  return height;
}

/// Places pictures from left to right and line after line.
class Grid {
 public:
  Grid(Canvas* canvas, int top, int words, int height)
      : canvas_(*canvas), top_(top), words_(words), height_(height) {}

  void Put(const std::string& words, const std::string& below, const agent::Picture& picture,
           const cv::Scalar& color) {
    if (column_ == kAcross) NewLine();
    const int x = kMargin + column_++ * (kSide + kGap);
    canvas_.Paragraph(x, top_, kSide, words, {});
    canvas_.Image(x, top_ + words_, kSide, picture, color);
    canvas_.Text(x, top_ + words_ + height_ + 4, below, {0.38, cv::Scalar(90, 90, 90), false});
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

double MeanAbsoluteError(const agent::Picture& a, const agent::Picture& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.rgb.size(); ++i) sum += std::abs(a.rgb[i] - b.rgb[i]);
  return a.empty() ? 0 : sum / 255 / static_cast<double>(a.rgb.size());
}

void WriteFuturesSheet(const FuturesSheet& sheet, const std::string& path) {
  Canvas canvas(2 * kMargin + kAcross * kSide + (kAcross - 1) * kGap);
  const int top = canvas.Text(kMargin, kMargin, sheet.title, {0.7, cv::Scalar(40, 40, 40), false});
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
  canvas.Write(path, bottom + kMargin / 2);
}

void WritePicture(const agent::Picture& picture, const std::string& path) {
  const cv::Mat rgb(picture.height, picture.width, CV_8UC3,
                    const_cast<std::uint8_t*>(picture.rgb.data()));
  cv::Mat bgr;
  cv::cvtColor(rgb, bgr, cv::COLOR_RGB2BGR);
  std::vector<unsigned char> png;
  cv::imencode(".png", bgr, png);
  base::WriteFile(path, {reinterpret_cast<const char*>(png.data()), png.size()});
}

}  // namespace prospect::services
