// Errors of gyroscopes and accelerometers against what is known by hand.
#include <gtest/gtest.h>

#include <cmath>

#include "simulator/effects/inertial_sensor_law.h"
#include "tests/effects/expression.h"
#include "tests/effects/sampling.h"

namespace plumbline::effects {
namespace {

using Eigen::Vector3d;

Vector3d reading_of(const std::string& name, const Vector3d& values, const Vector3d& actual) {
  const auto law = std::dynamic_pointer_cast<const InertialSensorLaw>(Catalogue::all().find(name));
  const InertialReading reads = law->inertial_reading(values.data());
  return reads.gain * actual + reads.bias;
}

TEST(ImuBias, ShiftsEachAxis) {
  EXPECT_EQ(reading_of("imu_bias", {0.25, -0.5, 2.0}, {1.0, 2.0, 3.0}), Vector3d(1.25, 1.5, 5.0));
}

TEST(ImuScale, ScalesEachAxis) {
  EXPECT_EQ(reading_of("imu_scale", {1.5, 1.0, 0.5}, {1.0, 2.0, 3.0}), Vector3d(1.5, 2.0, 1.5));
}

// A sensor at rest that is pitched up by an angle feels g as (-g sin, 0, g cos) when its nose is lowered
// about y, and one whose axes are turned by a about z sees the world turned by -a.
TEST(ImuMisalignment, TurnsTheAxesNotTheWorld) {
  const double a = 0.3, g = 9.81;
  const Vector3d lowered = reading_of("imu_misalignment", {0.0, a, 0.0}, {0.0, 0.0, g});
  EXPECT_LT((lowered - Vector3d(-g * std::sin(a), 0.0, g * std::cos(a))).norm(), 1e-14);
  const Vector3d turned = reading_of("imu_misalignment", {0.0, 0.0, a}, {2.0, 0.0, 1.0});
  EXPECT_LT((turned - Vector3d(2.0 * std::cos(a), -2.0 * std::sin(a), 1.0)).norm(), 1e-14);
}

// A third of a turn about the diagonal sends x to y, y to z and z to x; the sensor sees the way back.
TEST(ImuMisalignment, IsARotationVector) {
  const double third = 2.0 * 3.14159265358979323846 / 3.0;
  const Vector3d r = third / std::sqrt(3.0) * Vector3d::Ones();
  EXPECT_LT((reading_of("imu_misalignment", r, {1.0, 2.0, 3.0}) - Vector3d(2.0, 3.0, 1.0)).norm(), 1e-14);
}

TEST(InertialSensorLaw, NullValuesPassReadingsOn) {
  int tried = 0;
  for (const auto& law : all_laws()) {
    const auto inertial = std::dynamic_pointer_cast<const InertialSensorLaw>(law);
    if (!inertial) continue;
    ++tried;
    const InertialReading reads = inertial->inertial_reading(law->null_values().data());
    EXPECT_EQ(reads.gain, Eigen::Matrix3d::Identity()) << law->declaration().name;
    EXPECT_EQ(reads.bias, Vector3d::Zero()) << law->declaration().name;
  }
  EXPECT_EQ(tried, 3);
}

// The equations of components that the declarations write down.
TEST(InertialSensorLaw, ReadsWhatItsEquationSays) {
  Sampler sampler;
  for (const char* name : {"imu_bias", "imu_scale"}) {
    const auto law = std::dynamic_pointer_cast<const InertialSensorLaw>(Catalogue::all().find(name));
    const Equations equations(law->declaration().equation);
    const Values p = sampler.parameters(*law);
    const Vector3d actual(0.7, -1.3, 2.1);
    const InertialReading reads = law->inertial_reading(p.data());
    const Vector3d reading = reads.gain * actual + reads.bias;
    const std::map<std::string, double> symbols{{"x", p[0]},
                                                {"y", p[1]},
                                                {"z", p[2]},
                                                {"actual_x", actual.x()},
                                                {"actual_y", actual.y()},
                                                {"actual_z", actual.z()}};
    EXPECT_NEAR(reading.x(), equations.value("reading_x", symbols), 1e-14) << name;
    EXPECT_NEAR(reading.y(), equations.value("reading_y", symbols), 1e-14) << name;
    EXPECT_NEAR(reading.z(), equations.value("reading_z", symbols), 1e-14) << name;
  }
}

TEST(InertialSensorLaw, UnitsAreThoseOfTheSensor) {
  EXPECT_EQ(unit_at("{inertial}", true), "rad/s");
  EXPECT_EQ(unit_at("{inertial}", false), "m/s^2");
}

}  // namespace
}  // namespace plumbline::effects
