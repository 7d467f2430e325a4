#include "simulator/render/image.h"

#include <png.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "simulator/trace/error.h"
#include "simulator/trace/file_text.h"

namespace plumbline::render {
namespace {

png_image header() {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.format = PNG_FORMAT_RGB;
  return png;
}

/// Mean over a box of 2 r + 1 pixels in both directions, of one colour.
std::vector<double> blurred(const Image& image, std::size_t color, int r) {
  const int w = image.width;
  const int h = image.height;
  const auto at = [w](int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(w) + static_cast<std::size_t>(x);
  };
  std::vector<double> rows(image.rgb.size() / 3);
  std::vector<double> all(rows.size());
  for (int y = 0; y < h; ++y) {
    for (int x = 0; x < w; ++x) {
      const int from = std::max(0, x - r);
      const int to = std::min(w - 1, x + r);
      for (int i = from; i <= to; ++i) {
        rows[at(x, y)] += image.rgb[3 * at(i, y) + color] / static_cast<double>(to - from + 1);
      }
    }
  }
  for (int y = 0; y < h; ++y) {
    const int from = std::max(0, y - r);
    const int to = std::min(h - 1, y + r);
    for (int x = 0; x < w; ++x) {
      for (int i = from; i <= to; ++i) {
        all[at(x, y)] += rows[at(x, i)] / static_cast<double>(to - from + 1);
      }
    }
  }
  return all;
}

}  // namespace

void write_png(const Image& image, const std::string& file) {
  replace_file(file, [&](const std::string& temporary) {
    png_image png = header();
    png.width = static_cast<png_uint_32>(image.width);
    png.height = static_cast<png_uint_32>(image.height);
    if (png_image_write_to_file(&png, temporary.c_str(), 0, image.rgb.data(), 0, nullptr) == 0) {
      throw InputError({file, 0, ""}, std::string("a file that cannot be written (") + png.message + ")",
                       "room for a picture");
    }
  });
}

Image read_png(const std::string& file) {
  png_image png = header();
  if (png_image_begin_read_from_file(&png, file.c_str()) == 0) {
    throw InputError({file, 0, ""}, std::string("no picture (") + png.message + ")", "a PNG file");
  }
  png.format = PNG_FORMAT_RGB;
  Image image(static_cast<int>(png.width), static_cast<int>(png.height));
  if (png_image_finish_read(&png, nullptr, image.rgb.data(), 0, nullptr) == 0) {
    throw InputError({file, 0, ""}, std::string("a broken picture (") + png.message + ")", "a PNG file");
  }
  return image;
}

Image blend(const Image& one, const Image& other, double share) {
  Image image = one;
  const int weight = static_cast<int>(std::lround(256.0 * share));
  for (std::size_t i = 0; i < image.rgb.size(); ++i) {
    image.rgb[i] =
        static_cast<std::uint8_t>((weight * one.rgb[i] + (256 - weight) * other.rgb[i] + 128) / 256);
  }
  return image;
}

Image shrink(const Image& image, int factor) {
  Image small(image.width / factor, image.height / factor);
  const auto f = static_cast<std::size_t>(factor);
  const auto w = static_cast<std::size_t>(small.width);
  const auto full = static_cast<std::size_t>(image.width);
  const auto count = static_cast<unsigned>(factor * factor);
  for (std::size_t i = 0; i < small.rgb.size(); ++i) {
    const std::size_t color = i % 3;
    const std::size_t x = i / 3 % w;
    const std::size_t y = i / 3 / w;
    unsigned sum = count / 2;
    for (std::size_t v = 0; v < f; ++v) {
      for (std::size_t u = 0; u < f; ++u) {
        sum += image.rgb[3 * ((y * f + v) * full + x * f + u) + color];
      }
    }
    small.rgb[i] = static_cast<std::uint8_t>(sum / count);
  }
  return small;
}

double visible_difference(const Image& one, const Image& other) {
  if (one.width != other.width || one.height != other.height) {
    return std::numeric_limits<double>::infinity();
  }
  double sum = 0.0;
  for (std::size_t color = 0; color < 3; ++color) {
    const std::vector<double> a = blurred(one, color, 2);
    const std::vector<double> b = blurred(other, color, 2);
    for (std::size_t i = 0; i < a.size(); ++i) {
      sum += (a[i] - b[i]) * (a[i] - b[i]);
    }
  }
  return std::sqrt(sum / static_cast<double>(one.rgb.size()));
}

}  // namespace plumbline::render
