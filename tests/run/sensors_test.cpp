// The robot's sensors: counts, readings and their noise.
#include "simulator/run/sensors.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plumbline::run {
namespace {

model::Model two_sensors(double noise) {
  model::Model model;
  model::Sensor coarse;
  coarse.name = "coarse";
  coarse.resolution = 0.1;
  coarse.noise = noise;
  model::Sensor fine;
  fine.name = "fine";
  model.sensors = {coarse, fine};
  model.feet.resize(1);
  model.switches.push_back({"switch", 0, "test"});
  return model;
}

TEST(Sensors, CountsAreTheNearestAndReadingsWhatTheyMean) {
  const model::Model model = two_sensors(0.0);
  Sensors sensors(model, {});
  Sensed sensed;
  std::vector<model::Touch> touches(1);
  touches[0].depth = 1e-6;
  sensors.read(Eigen::Vector2d(0.26, 0.26), touches, sensed);
  EXPECT_EQ(sensed.counts[0], 3.0);
  EXPECT_DOUBLE_EQ(sensed.readings[0], 0.3);
  EXPECT_EQ(sensed.readings[1], 0.26);
  EXPECT_EQ(sensed.switches[0], 1.0);
  touches[0].depth = -1e-6;
  sensors.read(Eigen::Vector2d(-0.26, 0.0), touches, sensed);
  EXPECT_EQ(sensed.counts[0], -3.0);
  EXPECT_EQ(sensed.switches[0], 0.0);
}

TEST(Sensors, WithoutQuantisationCountsKeepTheirFraction) {
  const model::Model model = two_sensors(0.0);
  SensorOptions options;
  options.quantise = false;
  Sensors sensors(model, options);
  Sensed sensed;
  sensors.read(Eigen::Vector2d(0.26, 0.26), std::vector<model::Touch>(1), sensed);
  EXPECT_DOUBLE_EQ(sensed.counts[0], 2.6);
  EXPECT_DOUBLE_EQ(sensed.readings[0], 0.26);
  EXPECT_EQ(sensed.counts[1], 0.0);
}

TEST(Sensors, NoiseHasItsDeviationAndComesAgainWithTheSeed) {
  const model::Model model = two_sensors(0.5);
  SensorOptions options;
  options.quantise = false;
  Sensors first(model, options);
  Sensors again(model, options);
  Sensed a, b;
  double square = 0.0;
  const std::vector<model::Touch> touches(1);
  for (int k = 0; k < 4000; ++k) {
    first.read(Eigen::Vector2d::Zero(), touches, a);
    again.read(Eigen::Vector2d::Zero(), touches, b);
    ASSERT_EQ(a.readings[0], b.readings[0]);
    square += a.readings[0] * a.readings[0] / 4000.0;
  }
  EXPECT_NEAR(std::sqrt(square), 0.5, 0.5 * 3.0 / std::sqrt(2.0 * 4000.0));  // three standard errors
  EXPECT_EQ(a.readings[1], 0.0);
}

}  // namespace
}  // namespace plumbline::run
