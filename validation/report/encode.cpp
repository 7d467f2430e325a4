#include "validation/report/encode.h"

#include <openssl/evp.h>

#include <cmath>
#include <cstdint>
#include <limits>

namespace plumbline::validation {
namespace {

constexpr double kLargest = 32767.0;
constexpr std::int16_t kNothing = std::numeric_limits<std::int16_t>::min();

/// Six significant digits are plenty for a middle and a step of 16-bit numbers, and shorter in the page.
double rounded(double value) { return static_cast<double>(static_cast<float>(value)); }

struct Reach {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
};

Reach reach_of(const Eigen::VectorXd& points, Eigen::Index first, Eigen::Index count) {
  Reach reach;
  for (Eigen::Index i = first; i < first + count; ++i) {
    if (std::isfinite(points[i])) {
      reach.low = std::min(reach.low, points[i]);
      reach.high = std::max(reach.high, points[i]);
    }
  }
  return reach;
}

}  // namespace

std::string base64(const void* bytes, std::size_t count) {
  std::string text(4 * ((count + 2) / 3) + 1, '\0');
  const int length = EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data()),
                                     static_cast<const unsigned char*>(bytes), static_cast<int>(count));
  text.resize(static_cast<std::size_t>(length));
  return text;
}

std::string floats(const Eigen::VectorXd& values) {
  const Eigen::VectorXf shorter = values.cast<float>();
  return base64(shorter.data(), static_cast<std::size_t>(shorter.size()) * sizeof(float));
}

nlohmann::json packed(const Eigen::VectorXd& points, const std::vector<Block>& blocks) {
  std::vector<std::int16_t> all(static_cast<std::size_t>(points.size()), kNothing);
  nlohmann::json middles = nlohmann::json::array();
  nlohmann::json steps = nlohmann::json::array();
  Eigen::Index first = 0;
  for (const Block& block : blocks) {
    const Reach reach = reach_of(points, first, block.points());
    const bool any = reach.low <= reach.high;
    const double middle = any ? rounded(0.5 * (reach.low + reach.high)) : 0.0;
    // A little more than half the range, because the middle was rounded.
    const double half = any ? std::max(reach.high - middle, middle - reach.low) : 0.0;
    const double step = half > 0.0 ? rounded(half * (1.0 + 1e-6) / kLargest) : 1.0;
    for (Eigen::Index i = first; i < first + block.points(); ++i) {
      if (std::isfinite(points[i])) {
        all[static_cast<std::size_t>(i)] =
            static_cast<std::int16_t>(std::lround((points[i] - middle) / step));
      }
    }
    middles.push_back(middle);
    steps.push_back(step);
    first += block.points();
  }
  return {{"middle", middles}, {"step", steps}, {"data", base64(all.data(), 2 * all.size())}};
}

}  // namespace plumbline::validation
