// Markers, orientations, gyroscopes and accelerometers against closed forms, and what follows from them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "simulator/model/known_effects.h"
#include "simulator/model/plant.h"
#include "simulator/model/positions_from.h"
#include "simulator/model/robot_file.h"
#include "simulator/model/rotation_vector.h"
#include "tests/trace/refusal.h"
#include "tests/trace/temporary_folder.h"

namespace plumbline::model {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using testing::HasSubstr;

constexpr double kGravity = 9.7;

/// A pendulum about y; its rod lies along -z at zero.
constexpr const char* kPendulum = R"(<mujoco><option gravity="0 0 -9.7"/><worldbody>
  <body name="rod" pos="0.1 0 2"><joint name="pivot" axis="0 1 0"/>
    <inertial pos="0 0 -0.4" mass="2" diaginertia="0.03 0.04 0.01"/></body>
  <body name="stand"><inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/></body>
</worldbody></mujoco>)";

constexpr const char* kBox = R"(<mujoco><option gravity="0 0 -9.7"/><worldbody>
  <body name="trunk"><freejoint/>
    <inertial pos="0.02 0.01 -0.03" mass="6" diaginertia="0.1 0.09 0.03"/>
    <body name="arm" pos="0.2 0 0.1"><joint name="shoulder" axis="0 1 0"/>
      <inertial pos="0 0 -0.2" mass="1" diaginertia="0.01 0.01 0.002"/></body></body>
</worldbody></mujoco>)";

class PointSensors : public testing::Test {
 protected:
  Model model(const std::string& skeleton, const std::string& sensors, const std::string& more = "") const {
    folder_.write("robot.xml", skeleton);
    return read_model(
        folder_.write("model.yaml",
                      "plumbline: model/1\nrobot: r\nskeleton: robot.xml\nsensors:\n" + sensors + more),
        known_effects());
  }
  test::TemporaryFolder folder_;
};

Vector3d three(const Eigen::VectorXd& y, const Model& model, const std::string& name) {
  return y.segment<3>(model.sensor_index(name + "_x"));
}

constexpr const char* kRodSensors = R"(
  tip:  {marker: rod, at: {value: [0, 0, -700], unit: mm}, noise: {value: 1, unit: mm}, assumed: test}
  turn: {orientation: rod, noise: {value: 0.1, unit: deg}, assumed: test}
  gyro: {gyroscope: rod, turn: {value: [0, 0, 90], unit: deg}, noise: {value: 0.01, unit: rad/s}, assumed: test}
  acc:  {accelerometer: rod, at: {value: [0, 0, -0.7], unit: m}, noise: {value: 0.1, unit: m/s^2}, assumed: test}
)";

// Along the rod the accelerometer feels r w^2 + g cos q, across it r dw/dt + g sin q: of a free pendulum
// dw/dt = -m g c sin q/(I + m c^2).
TEST_F(PointSensors, APendulumsClosedForms) {
  const Model of = model(kPendulum, kRodSensors);
  Plant plant(of, {});
  ASSERT_EQ(plant.sensors(), 12);
  const double q = 0.7, w = -3.0, r = 0.7;
  const Eigen::Vector2d x(q, w);
  Eigen::VectorXd y(12);
  plant.outputs(x.data(), y.data());
  const double turning = -2.0 * kGravity * 0.4 * std::sin(q) / (0.04 + 2.0 * 0.16);
  // A turn by q about y takes -z to (-sin q, 0, -cos q).
  EXPECT_LT((three(y, of, "tip") - Vector3d(0.1 - r * std::sin(q), 0.0, 2.0 - r * std::cos(q))).norm(),
            1e-14);
  EXPECT_LT((three(y, of, "turn") - Vector3d(0.0, q, 0.0)).norm(), 1e-14);
  // Its x axis is the rod's y.
  EXPECT_LT((three(y, of, "gyro") - Vector3d(w, 0.0, 0.0)).norm(), 1e-14);
  const Vector3d expected(-r * turning - kGravity * std::sin(q), 0.0, r * w * w + kGravity * std::cos(q));
  EXPECT_LT((three(y, of, "acc") - expected).norm(), 1e-12);
}

// In free fall nothing is felt at the centre of mass, whatever the turn; held up, g upwards.
TEST_F(PointSensors, FreeFallAndRest) {
  const std::string stone = R"(<mujoco><option gravity="0 0 -9.7"/><worldbody><body name="stone"><freejoint/>
    <inertial pos="0.02 0.01 -0.03" mass="6" diaginertia="0.1 0.09 0.03"/></body></worldbody></mujoco>)";
  const std::string at =
      "  acc: {accelerometer: stone, at: {value: [0.02, 0.01, -0.03], unit: m}, noise: "
      "{value: 0.1, unit: m/s^2}, assumed: test}\n";
  const Model of = model(stone, at);
  Eigen::VectorXd y(3);
  Plant falling(of, {});
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(12, -0.8, 1.1);
  falling.outputs(x.data(), y.data());
  EXPECT_LT(y.norm(), 1e-12);
  Plant hangs(
      model(kPendulum, "  acc: {accelerometer: rod, noise: {value: 0.1, unit: m/s^2}, assumed: test}\n"), {});
  const Eigen::Vector2d hanging(0.0, 0.0);
  hangs.outputs(hanging.data(), y.data());
  EXPECT_LT((y - Vector3d(0.0, 0.0, kGravity)).norm(), 1e-13);
}

/// Central differences of outputs(), an orientation's as turns between its readings.
Eigen::MatrixXd differences(Plant& plant, const Eigen::VectorXd& x) {
  constexpr double kStep = 1e-6;
  Eigen::MatrixXd C(plant.sensors(), 2 * plant.positions());
  Eigen::VectorXd up(plant.sensors()), down(plant.sensors());
  for (Eigen::Index i = 0; i < C.cols(); ++i) {
    Eigen::VectorXd moved = x;
    moved[i] += kStep;
    plant.outputs(moved.data(), up.data());
    moved[i] -= 2.0 * kStep;
    plant.outputs(moved.data(), down.data());
    C.col(i) = (up - down) / (2.0 * kStep);
    for (int s = 0; s < plant.sensors(); ++s) {
      const Sensor& sensor = plant.model().sensors[static_cast<std::size_t>(s)];
      if (sensor.reading == PointReading::orientation && sensor.axis == 0) {
        C.block<3, 1>(s, i) = turn_between(down.segment<3>(s), up.segment<3>(s)) / (2.0 * kStep);
      }
    }
  }
  return C;
}

constexpr const char* kTrunkSensors = R"(
  nose: {marker: trunk, at: {value: [0.3, 0.1, 0], unit: m}, noise: {value: 1, unit: mm}, assumed: test}
  turn: {orientation: trunk, turn: {value: [10, 20, 30], unit: deg}, noise: {value: 0.1, unit: deg}, assumed: test}
  gyro: {gyroscope: arm, noise: {value: 0.01, unit: rad/s}, assumed: test}
  acc:  {accelerometer: arm, at: {value: [0, 0.1, -0.3], unit: m}, noise: {value: 0.1, unit: m/s^2}, assumed: test}
  elbow: {measures: shoulder, resolution: {value: 1e-4, unit: rad, assumed: test}}
)";

TEST_F(PointSensors, SlopesAreThoseOfTheReadings) {
  Plant plant(model(kBox, kTrunkSensors), {});
  const int n = plant.positions();
  std::srand(11);
  for (int trial = 0; trial < 10; ++trial) {
    Eigen::VectorXd x = Eigen::VectorXd::Random(2 * n);
    Eigen::MatrixXd C;
    plant.output_jacobian(x.data(), C);
    // What the accelerations add, of which output_jacobian() knows nothing.
    Eigen::MatrixXd A(n, 2 * n);
    Eigen::VectorXd up(2 * n), down(2 * n);
    for (int i = 0; i < 2 * n; ++i) {
      Eigen::VectorXd moved = x;
      moved[i] += 1e-6;
      plant.rate(moved.data(), nullptr, up.data());
      moved[i] -= 2e-6;
      plant.rate(moved.data(), nullptr, down.data());
      A.col(i) = (up - down).tail(n) / 2e-6;
    }
    C += plant.acceleration_map(x.data()) * A;
    EXPECT_LT((C - differences(plant, x)).cwiseAbs().maxCoeff(), 1e-6) << "state " << trial;
  }
}

// Where no coordinate is measured a marker and an orientation show where the base is, and how it moves.
TEST_F(PointSensors, PositionsFollowFromPoses) {
  const Model of = model(kBox, kTrunkSensors);
  Plant plant(of, {});
  const int n = plant.positions();
  std::vector<Observation> channels;
  std::vector<int> sensors;
  for (const char* name : {"nose_x", "nose_y", "nose_z", "turn_x", "turn_y", "turn_z", "elbow"}) {
    sensors.push_back(of.sensor_index(name));
    channels.push_back(observe_sensor(plant, sensors.back()));
  }
  const PositionsFrom from(plant, channels);
  EXPECT_TRUE(from.determined());
  std::srand(4);
  for (int trial = 0; trial < 20; ++trial) {
    Eigen::VectorXd x = 1.2 * Eigen::VectorXd::Random(2 * n);
    const double h = 1e-6;
    Eigen::VectorXd y(plant.sensors()), later(plant.sensors());
    plant.outputs(x.data(), y.data());
    Eigen::VectorXd behind = x;
    behind.head(n) += h * x.tail(n);
    plant.outputs(behind.data(), later.data());
    Eigen::MatrixXd values(7, 1), rates(7, 1);
    for (int c = 0; c < 7; ++c) {
      values(c, 0) = y[sensors[static_cast<std::size_t>(c)]];
      rates(c, 0) = (later[sensors[static_cast<std::size_t>(c)]] - values(c, 0)) / h;
    }
    const Eigen::MatrixXd z = from.positions(values);
    EXPECT_LT((z - x.head(n)).norm(), 1e-9) << "state " << trial;
    EXPECT_LT((from.rates(rates, z, values) - x.tail(n)).norm(), 1e-4) << "state " << trial;
  }
}

// R exp([d]) in the place of R, to first order and far from zero.
TEST(RotationVector, RightJacobian) {
  for (const double size : {1e-6, 0.3, 2.5, 4.0}) {
    const Vector3d r = size * Vector3d(0.6, -0.64, 0.48);
    const Vector3d d = 1e-6 * Vector3d(1.0, 2.0, -0.5);
    EXPECT_LT((turn_between(r, r + d) - right_jacobian(r) * d).norm(), 1e-11) << size;
    EXPECT_LT((rotation_of(rotation_vector(rotation_of(r))) - rotation_of(r)).norm(), 1e-14);
  }
}

TEST_F(PointSensors, BadOnesAreRefusedInOneLine) {
  const auto refusal = [&](const std::string& sensors) {
    return test::refusal([&] { model(kPendulum, sensors); });
  };
  EXPECT_THAT(refusal("  m: {marker: rode, noise: {value: 1, unit: mm}, assumed: test}\n"),
              HasSubstr("model.yaml:5: sensors.m.marker: found \"rode\", expected the name of a link of the "
                        "skeleton; did you mean rod?"));
  EXPECT_THAT(refusal("  m: {marker: stand, noise: {value: 1, unit: mm}, assumed: test}\n"),
              HasSubstr("which no joint moves"));
  EXPECT_THAT(refusal("  m: {gyroscope: rod, assumed: test}\n"), HasSubstr("neither resolution nor noise"));
  EXPECT_THAT(refusal("  m: {gyroscope: rod, noise: {value: 1, unit: m}, assumed: test}\n"),
              HasSubstr("sensors.m.noise"));
  EXPECT_THAT(
      refusal("  m: {gyroscope: rod, at: {value: [0, 0, 0], unit: m}, noise: {value: 1, unit: rad/s}, "
              "assumed: test}\n"),
      HasSubstr("sensors.m.at"));
}

}  // namespace
}  // namespace plumbline::model
