// Encodings against published vectors, and packed numbers against what a reader makes of them.
#include "validation/report/encode.h"

#include <gmock/gmock.h>

#include <cmath>
#include <cstdint>
#include <limits>

namespace plumbline::validation {
namespace {

TEST(Base64, AgreesWithRfc4648) {
  const std::vector<std::pair<std::string, std::string>> vectors{{"", ""},
                                                                 {"f", "Zg=="},
                                                                 {"fo", "Zm8="},
                                                                 {"foo", "Zm9v"},
                                                                 {"foob", "Zm9vYg=="},
                                                                 {"fooba", "Zm9vYmE="},
                                                                 {"foobar", "Zm9vYmFy"}};
  for (const auto& [plain, coded] : vectors) {
    EXPECT_EQ(base64(plain.data(), plain.size()), coded);
  }
}

/// Reads base64 (without padding rules: enough for whole 16-bit numbers).
std::vector<std::int16_t> numbers_of(const std::string& text) {
  static const std::string kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned bits = 0;
  int have = 0;
  for (const char c : text) {
    if (c == '=') {
      break;
    }
    bits = (bits << 6U) | static_cast<unsigned>(kDigits.find(c));
    have += 6;
    if (have >= 8) {
      have -= 8;
      bytes += static_cast<char>((bits >> static_cast<unsigned>(have)) & 255U);
    }
  }
  std::vector<std::int16_t> numbers;
  for (std::size_t i = 0; i + 1 < bytes.size(); i += 2) {
    const auto low = static_cast<unsigned>(static_cast<unsigned char>(bytes[i]));
    const auto high = static_cast<unsigned>(static_cast<unsigned char>(bytes[i + 1]));
    numbers.push_back(static_cast<std::int16_t>(low | (high << 8U)));
  }
  return numbers;
}

TEST(Packed, ComesBackWithinHalfAStepOfItsBlock) {
  const std::vector<Block> blocks{{0, 100, 1}, {100, 50, 1}};
  Eigen::VectorXd points(150);
  for (Eigen::Index i = 0; i < 150; ++i) {
    // a coarse block and a fine one far from zero
    points[i] =
        i < 100 ? 1000.0 * std::sin(0.1 * static_cast<double>(i)) : 5.0 + 1e-4 * static_cast<double>(i);
  }
  const nlohmann::json coded = packed(points, blocks);
  const std::vector<std::int16_t> q = numbers_of(coded["data"]);
  ASSERT_EQ(q.size(), 150U);
  for (Eigen::Index i = 0; i < 150; ++i) {
    const std::size_t b = i < 100 ? 0 : 1;
    const double range = b == 0 ? 2000.0 : 49e-4;
    const double back =
        coded["middle"][b].get<double>() + coded["step"][b].get<double>() * q[static_cast<std::size_t>(i)];
    // half of range/65534, and the middle's rounding to a float
    EXPECT_NEAR(back, points[i], 0.51 * range / 65534.0) << i;
  }
}

TEST(Packed, ConstantsAndGaps) {
  Eigen::VectorXd points = Eigen::VectorXd::Constant(4, 0.25);
  points[2] = std::numeric_limits<double>::quiet_NaN();
  const nlohmann::json coded = packed(points, {{0, 4, 1}});
  EXPECT_EQ(coded["middle"][0], 0.25);
  EXPECT_THAT(numbers_of(coded["data"]), testing::ElementsAre(0, 0, -32768, 0));
}

}  // namespace
}  // namespace plumbline::validation
