// For builds without OpenCV: a sheet is a sheet without words, too.

#include "tools/dataset/caption.h"

namespace prospect::tools {

void DrawCaption(const std::string&, int, int, sim::Image*) {}

}  // namespace prospect::tools
