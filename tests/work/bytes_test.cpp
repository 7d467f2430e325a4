// Results as bytes, and how long tasks took.
#include "work/bytes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <stdexcept>

#include "work/durations.h"

namespace plumbline::work {
namespace {

TEST(Bytes, ComeBackToTheLastBit) {
  const double tiny = std::numeric_limits<double>::denorm_min(), third = 1.0 / 3.0;
  const std::string text("a line\nand a zero\0 within", 25);
  const std::string all = Bytes()
                              .add(third)
                              .add(text)
                              .add(std::vector<double>{tiny, -0.0, INFINITY, NAN})
                              .add(std::string())
                              .add(std::vector<double>())
                              .all();
  BytesReader reader(all);
  EXPECT_EQ(reader.number(), third);
  EXPECT_EQ(reader.text(), text);
  const std::vector<double> numbers = reader.numbers();
  ASSERT_EQ(numbers.size(), 4U);
  EXPECT_EQ(numbers[0], tiny);
  EXPECT_TRUE(std::signbit(numbers[1]));
  EXPECT_EQ(numbers[2], INFINITY);
  EXPECT_TRUE(std::isnan(numbers[3]));
  EXPECT_FALSE(reader.at_end());
  EXPECT_EQ(reader.text(), "");
  EXPECT_TRUE(reader.numbers().empty());
  EXPECT_TRUE(reader.at_end());
  EXPECT_THROW(reader.number(), std::out_of_range);
}

TEST(Durations, KeepTheLongestAndPassOverWhatTheyCannotRead) {
  const std::string file = testing::TempDir() + "durations.csv";
  std::ofstream(file) << "run,seconds\nstart 0,2.5\nwith, a comma,7\nbroken\nstart 1,\n";
  Durations durations(file);
  EXPECT_EQ(durations.of("start 0"), 2.5);
  EXPECT_EQ(durations.of("with, a comma"), 7.0);
  EXPECT_EQ(durations.of("start 1"), 0.0);
  EXPECT_EQ(durations.of("run"), 0.0);
  durations.add("start 0", 0.001);  // only read again
  durations.add("start 1", 3.0);
  std::ofstream(file) << durations.text("run");
  EXPECT_EQ(Durations(file).of("start 0"), 2.5);
  EXPECT_EQ(Durations(file).of("start 1"), 3.0);
  EXPECT_EQ(Durations("/no/such/file").of("start 0"), 0.0);
}

}  // namespace
}  // namespace plumbline::work
