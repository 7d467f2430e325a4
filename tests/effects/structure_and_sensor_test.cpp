// Changes of constants land where they belong.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "simulator/effects/late_sensor_law.h"
#include "simulator/effects/losing_sensor_law.h"
#include "tests/effects/rk4.h"
#include "tests/effects/sampling.h"

namespace plumbline::effects {
namespace {

StructureChange change_of(const std::string& name, const std::vector<std::pair<std::string, double>>& given) {
  const auto law = std::dynamic_pointer_cast<const StructureLaw>(Catalogue::all().find(name));
  return law->change(values_of(*law, given).data());
}

double reading_of(const std::string& name, const std::string& parameter, double value, double actual) {
  const auto law = std::dynamic_pointer_cast<const SensorLaw>(Catalogue::all().find(name));
  return law->reading(actual, values_of(*law, {{parameter, value}}).data());
}

TEST(RotorInertia, ChangesTheInertiaOnly) {
  const StructureChange change = change_of("rotor_inertia", {{"inertia", -1e-4}});
  EXPECT_EQ(change.inertia, -1e-4);
  EXPECT_EQ(change.mass, 0.0);
  EXPECT_EQ(change.com_shift.norm() + change.tilt.norm(), 0.0);
}

TEST(AddedMass, ChangesTheMassOnly) {
  const StructureChange change = change_of("added_mass", {{"mass", 1.5}});
  EXPECT_EQ(change.mass, 1.5);
  EXPECT_EQ(change.inertia, 0.0);
  EXPECT_EQ(change.com_shift.norm() + change.tilt.norm(), 0.0);
}

TEST(ComShift, MovesTheCentreOfMassOnly) {
  const StructureChange change = change_of("com_shift", {{"x", 0.01}, {"y", -0.02}, {"z", 0.03}});
  EXPECT_EQ(change.com_shift, Eigen::Vector3d(0.01, -0.02, 0.03));
  EXPECT_EQ(change.inertia + change.mass + change.tilt.norm(), 0.0);
}

// A rotation by r about x turns (0, 0, -g) into (0, g sin r, -g cos r); by r about y into (-g sin r, 0, -g
// cos r).
TEST(GravityTilt, TurnsGravityAboutTheWorldsAxes) {
  const double g = 9.80665, angle = 0.1;
  const auto tilted = [&](const StructureChange& change) -> Eigen::Vector3d {
    const double size = change.tilt.norm();
    return Eigen::AngleAxisd(size, change.tilt / size) * Eigen::Vector3d(0, 0, -g);
  };
  const Eigen::Vector3d rolled = tilted(change_of("gravity_tilt", {{"roll", angle}}));
  EXPECT_TRUE(rolled.isApprox(Eigen::Vector3d(0, g * std::sin(angle), -g * std::cos(angle)), 1e-12));
  const Eigen::Vector3d pitched = tilted(change_of("gravity_tilt", {{"pitch", angle}}));
  EXPECT_TRUE(pitched.isApprox(Eigen::Vector3d(-g * std::sin(angle), 0, -g * std::cos(angle)), 1e-12));
}

TEST(EncoderOffset, ShiftsTheReading) {
  EXPECT_DOUBLE_EQ(reading_of("encoder_offset", "offset", 0.25, -1.0), -0.75);
}

// A disc whose centre is e beside its axis shows, at radius r, the angle of a point seen from the centre: to
// first order in e/r the true one and e/r sin(angle).
TEST(EncoderEccentricity, IsADiscBesideItsAxis) {
  const double e = 1e-4, r = 0.02;
  const auto law = std::dynamic_pointer_cast<const SensorLaw>(Catalogue::all().find("encoder_eccentricity"));
  const Values p = values_of(*law, {{"sine", -e / r}});
  for (const double angle : {-2.5, -0.4, 0.0, 1.1, 3.0}) {
    const double seen = std::atan2(r * std::sin(angle), r * std::cos(angle) + e);
    EXPECT_NEAR(law->reading(angle, p.data()), seen, e * e / (r * r));
  }
}

TEST(EncoderEccentricity, ReturnsAfterEveryWave) {
  const auto law = std::dynamic_pointer_cast<const SensorLaw>(Catalogue::all().find("encoder_eccentricity"));
  const Values p = values_of(*law, {{"sine", 0.01}, {"cosine", 0.02}, {"waves", 2.0}});
  const double half = 3.14159265358979323846;
  EXPECT_NEAR(law->reading(0.3 + half, p.data()) - law->reading(0.3, p.data()), half, 1e-14);
  EXPECT_NEAR(law->reading(0.0, p.data()), 0.02, 1e-16);
}

TEST(EncoderScale, ScalesTheReading) {
  EXPECT_DOUBLE_EQ(reading_of("encoder_scale", "scale", 1.02, -2.0), -2.04);
}

// A filter of first order with time constant T shows a ramp T late (its group delay at low frequencies).
TEST(SensorLag, IsTheGroupDelayOfAFilter) {
  const auto law = std::dynamic_pointer_cast<const LateSensorLaw>(Catalogue::all().find("sensor_lag"));
  ASSERT_TRUE(law);
  const double time_constant = 0.004, speed = 1.7;
  const Values p = values_of(*law, {{"lag", time_constant}});
  const Rate rate = [&](const State& s) { return State{1.0, (speed * s[0] - s[1]) / time_constant}; };
  const State end = rk4(rate, {0.0, 0.0}, 0.2, 4000);  // time and what the filter shows
  EXPECT_NEAR(law->reading(speed * end[0], p.data()) - law->lag(p.data()) * speed, end[1], 1e-9);
}

// A counter that misses every fifth edge above 2 rad/s, counted edge by edge: 3 rad/s for 2 s, 1 rad/s back.
TEST(LostCounts, MissesWhatACounterMisses) {
  const auto law = std::dynamic_pointer_cast<const LosingSensorLaw>(Catalogue::all().find("lost_counts"));
  ASSERT_TRUE(law);
  const Values p = values_of(*law, {{"share", 0.2}, {"limit_speed", 2.0}});
  const double edge = 1e-3;  // rad
  int counted = 0;
  int edges = 0;
  double lost = 0.0;
  const auto turn = [&](double speed, double time) {
    const int crossed = static_cast<int>(std::lround(std::abs(speed) * time / edge));
    for (int i = 0; i < crossed; ++i) {
      ++edges;
      const bool is_missed = std::abs(speed) > 2.0 && edges % 5 == 0;
      counted += is_missed ? 0 : (speed > 0.0 ? 1 : -1);
    }
    lost += time * law->loss_rate(speed, p.data());
  };
  turn(3.0, 2.0);
  turn(-1.0, 6.0);  // back where it was
  EXPECT_NEAR(lost, counted * edge, 2.0 * edge);
  EXPECT_NEAR(lost, -1.2, 2.0 * edge);
  turn(-3.0, 2.0);  // what is missed the other way makes up for it
  EXPECT_NEAR(lost, 0.0, 4.0 * edge);
  EXPECT_TRUE(law->is_null(values_of(*law, {{"limit_speed", 2.0}}).data()));
}

}  // namespace
}  // namespace plumbline::effects
