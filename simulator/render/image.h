// A picture in memory, and PNG files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace plumbline::render {

/// Red, green, blue bytes, rows from the top.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;

  Image() = default;
  Image(int w, int h)
      : width(w), height(h), rgb(3 * static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}
};

/// Writes beside `file` and renames. Throws InputError when the folder cannot be written.
void write_png(const Image& image, const std::string& file);
/// Throws InputError when there is no such picture.
Image read_png(const std::string& file);

/// share * one + (1 - share) * other, of equal size.
Image blend(const Image& one, const Image& other, double share);

/// Each pixel the mean of factor x factor ones.
Image shrink(const Image& image, int factor);

/// How different two pictures look: root mean square over pixels and colours, 0 to 255, after both have been
/// blurred by a box of 5 pixels, so that an edge that moved by less than a pixel counts little. Infinite for
/// unequal sizes.
double visible_difference(const Image& one, const Image& other);

}  // namespace plumbline::render
