// Trials with what is measured at points of links: three columns, or a quaternion.
#include <gmock/gmock.h>

#include <cmath>

#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"
#include "simulator/model/rotation_vector.h"
#include "tests/identify/trial/fixture.h"
#include "validation/identify/trial/trial.h"
#include "validation/identify/trial/write_trial.h"

namespace plumbline::validation {
namespace {

using testing::HasSubstr;

constexpr const char* kStone = R"(<mujoco><worldbody><body name="stone"><freejoint/>
  <inertial pos="0 0 0" mass="1" diaginertia="0.1 0.09 0.03"/></body></worldbody></mujoco>)";

constexpr const char* kModel = R"(plumbline: model/1
robot: stone
skeleton: stone.xml
sensors:
  turn: {orientation: stone, noise: {value: 0.1, unit: deg}, assumed: test}
  gyro: {gyroscope: stone, noise: {value: 0.01, unit: rad/s}, assumed: test}
)";

constexpr const char* kTrial = R"(plumbline: trial/1
title: A stone is turned
model: ../model.yaml
role: train
data: data.csv
time: {column: t, unit: s}
measured:
  turn: {columns: [w, x, y, z], unit: "1", noise: {value: 0.2, unit: deg}}
  gyro: {columns: [gx, gy, gz], unit: deg/s, offset_uncertainty: {value: 1, unit: deg/s}}
)";

class PointTrial : public ScratchFolder {
 protected:
  void SetUp() override {
    ScratchFolder::SetUp();
    std::filesystem::create_directories(folder / "turned");
    write_file(folder / "stone.xml", kStone);
    write_file(folder / "model.yaml", kModel);
    write_file(folder / "turned" / "trial.yaml", kTrial);
    write_file(folder / "turned" / "data.csv", csv(-1));
  }

  /// The stone turns about x once and a half in 30 samples; its quaternions change sign, as recorders' do.
  static double angle(int k) { return 3.0 * M_PI * k / 29.0; }
  static std::string csv(int bad_row) {
    std::ostringstream text;
    text.precision(16);
    text << "t,w,x,y,z,gx,gy,gz\n";
    for (int k = 0; k < 30; ++k) {
      const double length = k == bad_row ? 0.0 : k % 7 == 3 ? -1.001 : 1.0;
      text << 0.01 * k << "," << length * std::cos(0.5 * angle(k)) << "," << length * std::sin(0.5 * angle(k))
           << ",0,0," << k << "," << 2 * k << ",90\n";
    }
    return text.str();
  }
  model::Model stone() const {
    return model::read_model((folder / "model.yaml").string(), model::known_effects());
  }
  Trial read() const { return read_trial((folder / "turned").string(), stone()); }
};

TEST_F(PointTrial, ThreeColumnsAndAQuaternion) {
  const Trial trial = read();
  ASSERT_EQ(trial.measured.size(), 6U);
  EXPECT_EQ(trial.measured[0].sensor, "turn_x");
  EXPECT_NEAR(*trial.measured[2].noise, 0.2 * M_PI / 180.0, 1e-15);
  for (int k = 0; k < 30; ++k) {
    EXPECT_NEAR(trial.measured[0].values[k], angle(k), 1e-12) << "goes on past half a turn, row " << k;
    EXPECT_NEAR(trial.measured[1].values[k], 0.0, 1e-12);
  }
  EXPECT_EQ(trial.measured[4].sensor, "gyro_y");
  EXPECT_NEAR(trial.measured[4].values[10], 20.0 * M_PI / 180.0, 1e-14);
  EXPECT_NEAR(trial.measured[4].offset_uncertainty, M_PI / 180.0, 1e-14);
}

TEST_F(PointTrial, WrittenTrialsReadTheSame) {
  const Trial trial = read();
  const std::string to = (folder / "again").string();
  write_trial(trial, stone(), to);
  const Trial again = read_trial(to, stone());
  ASSERT_EQ(again.measured.size(), 6U);
  for (std::size_t c = 0; c < 6; ++c) {
    EXPECT_EQ(again.measured[c].sensor, trial.measured[c].sensor);
    EXPECT_LT((again.measured[c].values - trial.measured[c].values).cwiseAbs().maxCoeff(), 1e-9) << c;
  }
}

TEST_F(PointTrial, BadOnesAreRefusedInOneLine) {
  const auto refusal = [&](const std::string& what, const std::string& by) {
    write_file(folder / "turned" / "trial.yaml", replaced(kTrial, what, by));
    return input_error([&] { read(); });
  };
  EXPECT_THAT(refusal("[w, x, y, z]", "[w, x, y]"), HasSubstr("measured.turn.columns: found 3 columns"));
  EXPECT_THAT(refusal("[gx, gy, gz]", "[gx, gy]"), HasSubstr("measured.gyro.columns: found 2 columns"));
  EXPECT_THAT(refusal("unit: deg/s, off", "unit: deg, off"), HasSubstr("measured.gyro.unit"));
  EXPECT_THAT(refusal("[w, x, y, z]", "[w, x, y, v]"), HasSubstr("column \"v\""));
  EXPECT_THAT(refusal("turn: {columns: [w, x, y, z], unit: \"1\"", "turn_x: {column: w, unit: rad"),
              HasSubstr("a component of an orientation"));
  write_file(folder / "turned" / "trial.yaml", kTrial);
  write_file(folder / "turned" / "data.csv", csv(12));
  EXPECT_THAT(input_error([&] { read(); }),
              HasSubstr("a quaternion of length 0 in row 13, expected length 1"));
}

}  // namespace
}  // namespace plumbline::validation
