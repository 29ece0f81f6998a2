#include "sim/png.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <stdexcept>

namespace prospect::sim {
namespace {

Image Checker() { return {2, 2, {255, 0, 0, 0, 255, 0, 0, 0, 255, 9, 9, 9}}; }

TEST(Png, WritesASignedFile) {
  const std::string path = testing::TempDir() + "prospect_" + std::to_string(getpid()) + ".png";
  WritePng(path, Checker());
  std::ifstream file(path, std::ios::binary);
  char head[4] = {};
  file.read(head, 4);
  EXPECT_EQ(std::string(head + 1, 3), "PNG");
  std::remove(path.c_str());
}

TEST(Png, NamesTheFileItCannotWrite) {
  try {
    WritePng("/nonexistent/folder/a.png", Checker());
    FAIL() << "wrote into a folder that does not exist";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("/nonexistent/folder/a.png"), std::string::npos);
  }
}

TEST(Png, EnlargesByRepeating) {
  const Image large = Enlarge(Checker(), 3);
  ASSERT_EQ(large.width, 6);
  EXPECT_EQ(large.rgb[(2 * 6 + 2) * 3], 255);      // still the first pixel
  EXPECT_EQ(large.rgb[(2 * 6 + 3) * 3 + 1], 255);  // the second
  EXPECT_EQ(large.rgb[(5 * 6 + 5) * 3], 9);
}

TEST(Png, PastingCutsOffWhatLiesOutside) {
  Image canvas{3, 3, std::vector<std::uint8_t>(27, 1)};
  Paste(Checker(), 2, 2, &canvas);
  EXPECT_EQ(canvas.rgb[8 * 3], 255);
  Paste(Checker(), -1, -1, &canvas);
  EXPECT_EQ(canvas.rgb[0], 9);
  Paste(Checker(), 10, -10, &canvas);
  EXPECT_EQ(canvas.rgb[4 * 3], 1);
}

}  // namespace
}  // namespace prospect::sim
