// Pictures: files, mixing, and the measure by which two are held to look alike.
#include "simulator/render/image.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/trace/refusal.h"
#include "tests/trace/temporary_folder.h"

namespace plumbline::render {
namespace {

/// A dark square on white, its left edge at `left`.
Image square(int left) {
  Image image(64, 48);
  for (int y = 0; y < 48; ++y) {
    for (int x = 0; x < 64; ++x) {
      const bool inside = x >= left && x < left + 20 && y >= 10 && y < 30;
      for (std::size_t c = 0; c < 3; ++c) {
        image.rgb[3 * static_cast<std::size_t>(y * 64 + x) + c] = inside ? 40 : 255;
      }
    }
  }
  return image;
}

TEST(Picture, APngComesBackAsItWas) {
  const test::TemporaryFolder folder;
  write_png(square(7), folder.path("a.png"));
  EXPECT_EQ(read_png(folder.path("a.png")).rgb, square(7).rgb);
  EXPECT_EQ(folder.file_count(), 1U);
  folder.write("b.png", "no picture");
  test::refusal([&] { read_png(folder.path("b.png")); });
  test::refusal([&] { write_png(square(7), folder.path("none/a.png")); });
}

TEST(Picture, TheDifferenceGrowsWithWhatTheEyeSees) {
  const double none = visible_difference(square(20), square(20));
  const double shifted = visible_difference(square(20), square(21));
  const double moved = visible_difference(square(20), square(28));
  EXPECT_EQ(none, 0.0);
  EXPECT_LT(shifted, 12.0);
  EXPECT_GT(moved, 30.0);
  EXPECT_TRUE(std::isinf(visible_difference(square(20), Image(10, 10))));
}

TEST(Picture, MixesByItsShare) {
  Image black(1, 1);
  Image white(1, 1);
  white.rgb.assign(3, 255);
  EXPECT_EQ(blend(white, black, 0.25).rgb[0], 64);
  EXPECT_EQ(blend(white, white, 0.3).rgb, white.rgb);  // exactly: where nothing differs nothing changes
}

}  // namespace
}  // namespace plumbline::render
