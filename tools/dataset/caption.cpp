#include "tools/dataset/caption.h"

#include <opencv2/imgproc.hpp>

namespace prospect::tools {

void DrawCaption(const std::string& text, int x, int y, sim::Image* image) {
  cv::Mat canvas(image->height, image->width, CV_8UC3, image->rgb.data());
  cv::putText(canvas, text, cv::Point(x, y + 10), cv::FONT_HERSHEY_SIMPLEX, 0.36,
              cv::Scalar(20, 20, 20), 1, cv::LINE_AA);
}

}  // namespace prospect::tools
