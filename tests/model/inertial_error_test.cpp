// Errors of gyroscopes and accelerometers on a model: readings by hand, slopes by differences.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "simulator/model/effect_list.h"
#include "simulator/model/inertial_tangent.h"
#include "simulator/model/known_effects.h"
#include "simulator/model/plant.h"
#include "simulator/model/robot_file.h"
#include "tests/trace/refusal.h"
#include "tests/trace/temporary_folder.h"

namespace plumbline::model {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;

/// A pendulum about y; its rod lies along -z at zero.
constexpr const char* kSkeleton = R"(<mujoco><option gravity="0 0 -9.7"/><worldbody>
  <body name="rod" pos="0.1 0 2"><joint name="pivot" axis="0 1 0"/>
    <inertial pos="0 0 -0.4" mass="2" diaginertia="0.03 0.04 0.01"/></body>
</worldbody></mujoco>)";

constexpr const char* kModel = R"(plumbline: model/1
robot: pendulum
skeleton: robot.xml
coordinates: {pivot: {of: {pivot: 1}}}
sensors:
  angle: {measures: pivot, resolution: {value: 1e-4, unit: rad, assumed: test}}
  gyro: {gyroscope: rod, noise: {value: 0.01, unit: rad/s}, assumed: test}
  acc:  {accelerometer: rod, at: {value: [0, 0, -0.7], unit: m}, noise: {value: 0.1, unit: m/s^2}, assumed: test}
  turn: {orientation: rod, noise: {value: 0.1, unit: deg}, assumed: test}
)";

constexpr const char* kErrors = R"(effects:
  - {effect: imu_bias, at: gyro, values: {y: {value: 0.2, unit: rad/s, assumed: test}}}
  - {effect: imu_scale, at: acc, values: {z: {value: 1.1, unit: "1", assumed: test}}}
  - {effect: imu_misalignment, at: acc, values: {y: {value: 90, unit: deg, assumed: test}}}
  - {effect: imu_bias, at: acc, values: {x: {value: 0.5, unit: m/s^2, assumed: test}}}
)";

class InertialErrors : public testing::Test {
 protected:
  Model model(const std::string& effects) const {
    folder_.write("robot.xml", kSkeleton);
    return read_model(folder_.write("model.yaml", kModel + effects), known_effects());
  }
  Eigen::VectorXd read(Plant& plant) const {
    Eigen::VectorXd y(plant.sensors());
    plant.outputs(x_.data(), y.data());
    return y;
  }
  const Eigen::Vector2d x_{0.7, -3.0};  // angle, rad, and speed, rad/s
  test::TemporaryFolder folder_;
};

// The accelerometer at r feels (-r dw/dt - g sin q, 0, r w^2 + g cos q), dw/dt = -m g c sin q/(I + m c^2).
// Its z axis reads a tenth too much; turned by 90 degrees about y its x axis then points along the stated -z,
// and its z axis along the stated x.
TEST_F(InertialErrors, ActInTheOrderOfTheFile) {
  Plant plant(model(kErrors), {});
  const Eigen::VectorXd y = read(plant);
  const double q = x_[0], w = x_[1], r = 0.7, g = 9.7;
  const double turning = -2.0 * g * 0.4 * std::sin(q) / (0.04 + 2.0 * 0.16);
  const double across = -r * turning - g * std::sin(q);
  const double along = r * w * w + g * std::cos(q);
  const Vector3d gyro = y.segment<3>(plant.model().sensor_index("gyro_x"));
  const Vector3d acc = y.segment<3>(plant.model().sensor_index("acc_x"));
  EXPECT_LT((gyro - Vector3d(0.0, w + 0.2, 0.0)).norm(), 1e-13);
  EXPECT_LT((acc - Vector3d(-1.1 * along + 0.5, 0.0, across)).norm(), 1e-12);
}

TEST_F(InertialErrors, AtNullValuesNothingChanges) {
  Plant bare(model(""), {});
  Plant nested(model(R"(effects:
  - {effect: imu_bias, at: gyro}
  - {effect: imu_scale, at: acc}
  - {effect: imu_misalignment, at: acc}
)"),
               {});
  EXPECT_EQ(nested.states(), bare.states());
  EXPECT_EQ(read(nested), read(bare));
}

// By states as by parameters. Accelerations follow the state: their share is acceleration_map() d2z/dt2.
TEST_F(InertialErrors, SlopesAreThoseOfTheReadings) {
  Plant plant(model(kErrors), {});
  constexpr double kStep = 1e-6;
  Eigen::MatrixXd C;
  plant.output_jacobian(x_.data(), C);
  const Eigen::MatrixXd map = plant.acceleration_map(x_.data());
  for (Eigen::Index i = 0; i < 2; ++i) {
    Eigen::VectorXd y[2], rate[2];
    for (const int side : {0, 1}) {
      Eigen::Vector2d moved = x_;
      moved[i] += side == 0 ? kStep : -kStep;
      y[side].resize(plant.sensors());
      rate[side].resize(2);
      plant.outputs(moved.data(), y[side].data());
      plant.rate(moved.data(), nullptr, rate[side].data());
    }
    const Eigen::VectorXd slope = C.col(i) + map * (rate[0] - rate[1]).tail(1) / (2.0 * kStep);
    EXPECT_LT((slope - (y[0] - y[1]) / (2.0 * kStep)).norm(), 1e-6) << i;
  }
  std::vector<ParameterId> parameters;
  for (int effect = 0; effect < 4; ++effect) {
    for (int p = 0; p < 3; ++p) {
      parameters.push_back({effect, p});
    }
  }
  EXPECT_TRUE(is_any_inertial(plant.model(), parameters));
  Eigen::MatrixXd D = Eigen::MatrixXd::Zero(plant.sensors(), 12);
  add_inertial_tangent(plant, read(plant), parameters, Eigen::VectorXd::Constant(12, kStep), D);
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    const double here = plant.value(parameters[k]);
    plant.set_value(parameters[k], here + kStep);
    const Eigen::VectorXd up = read(plant);
    plant.set_value(parameters[k], here - kStep);
    const Eigen::VectorXd down = read(plant);
    plant.set_value(parameters[k], here);
    const Eigen::VectorXd expected = (up - down) / (2.0 * kStep);
    EXPECT_LT((D.col(static_cast<Eigen::Index>(k)) - expected).norm(), 1e-4) << k;
  }
}

// A tilt of gravity is felt through the errors: (0, 0, g) at rest, pitched by a, in turned axes.
TEST_F(InertialErrors, TheTiltIsFeltThroughThem) {
  const std::string tilt = "  - {effect: gravity_tilt, at: world}\n";
  Plant plant(model(kErrors + tilt), {});
  constexpr double kStep = 1e-6;
  const std::vector<ParameterId> pitch{{4, 1}};
  Eigen::MatrixXd D;
  plant.output_tangent(x_.data(), pitch, Eigen::VectorXd::Constant(1, kStep), D);
  Eigen::VectorXd rate(2), tilted(2);
  const Eigen::VectorXd before = read(plant);
  plant.rate(x_.data(), nullptr, rate.data());
  const Eigen::MatrixXd map = plant.acceleration_map(x_.data());
  plant.set_value(pitch.front(), kStep);
  const Eigen::VectorXd after = read(plant);
  plant.rate(x_.data(), nullptr, tilted.data());
  const Eigen::VectorXd held = (after - before - map * (tilted - rate).tail(1)) / kStep;
  EXPECT_LT((D.col(0) - held).norm(), 1e-4);
}

TEST_F(InertialErrors, UnitsFollowTheSensor) {
  const Model of = model(kErrors);
  EXPECT_EQ(parameter_unit(of, *of.effects[0].law, "gyro", 0), "rad/s");
  EXPECT_EQ(parameter_unit(of, *of.effects[3].law, "acc", 0), "m/s^2");
}

TEST_F(InertialErrors, BadOnesAreRefusedInOneLine) {
  const auto refusal = [&](const std::string& effect) {
    return test::refusal([&] { model("effects:\n  - " + effect + "\n"); });
  };
  EXPECT_THAT(refusal("{effect: imu_bias, at: angle}"),
              HasSubstr("found \"angle\", expected the name of a gyroscope or accelerometer of three axes"));
  EXPECT_THAT(refusal("{effect: imu_bias, at: gyr}"), HasSubstr("did you mean gyro?"));
  EXPECT_THAT(refusal("{effect: imu_bias, at: turn}"), HasSubstr("found \"turn\""));
  EXPECT_THAT(refusal("{effect: imu_bias, at: gyro_x}"), HasSubstr("found \"gyro_x\""));
  EXPECT_THAT(refusal("{effect: encoder_offset, at: gyro}"), HasSubstr("the name of a sensor"));
  EXPECT_THAT(refusal("{effect: imu_bias, at: gyro, values: {x: {value: 1, unit: m/s^2, assumed: test}}}"),
              HasSubstr("rad/s"));
  EXPECT_THAT(refusal("{effect: imu_scale, at: acc, values: {x: {value: 0, unit: \"1\", assumed: test}}}"),
              HasSubstr("a value from"));
}

}  // namespace
}  // namespace plumbline::model
