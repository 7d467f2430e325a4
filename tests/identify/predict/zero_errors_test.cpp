// Zero errors of a record's sensors begin where the feet that stand say.
#include "validation/identify/predict/zero_errors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"
#include "tests/identify/predict/hopper.h"

namespace plumbline::validation {
namespace {

// A hopper whose height is recorded 25 mm too high never meets its ground: no slope leads there. Its zero
// error begins where the foot has stood.
TEST(ZeroErrors, BeginWhereTheFootHasStood) {
  Data data({test::hopper_trial(test::hopper(), "bounce")}, {});
  Trial& trial = data.trials.front();
  trial.switches.clear();
  trial.contact_events.clear();
  const std::string height = trial.measured.front().sensor;
  trial.measured.front().values.array() += 0.025;
  trial.measured.front().offset_uncertainty = 0.03;
  const model::Model model = with_zero_errors(test::hopper(), data);
  ASSERT_EQ(model.effects.back().label(), "encoder_offset at " + height);
  EXPECT_NEAR(model.effects.back().values.front().value, 0.025, 0.002);
  EXPECT_EQ(model.effects.back().values.front().uncertainty, 0.03);
}

// A gyroscope's three components share one law, and only what was stated is free.
TEST(ZeroErrors, OfAGyroscopeAreItsBias) {
  model::Model model = test::hopper();
  for (int axis = 0; axis < 3; ++axis) {
    model::Sensor sensor;
    sensor.group = "gyro";
    sensor.name = std::string("gyro_") + "xyz"[axis];
    sensor.reading = model::PointReading::gyroscope;
    sensor.axis = axis;
    sensor.body = static_cast<int>(model.skeleton.bodies.size()) - 1;
    sensor.noise = 0.01;
    model.sensors.push_back(sensor);
  }
  Data data({test::hopper_trial(test::hopper(), "bounce")}, {});
  Trial& trial = data.trials.front();
  for (const char* name : {"gyro_x", "gyro_z"}) {
    Measured channel = trial.measured.front();
    channel.sensor = name;
    channel.values.setZero();
    channel.offset_uncertainty = 0.02;
    trial.measured.push_back(channel);
  }
  const std::size_t before = model.effects.size();
  const model::Model with = with_zero_errors(model, data);
  ASSERT_EQ(with.effects.size(), before + 1);
  EXPECT_EQ(with.effects.back().label(), "imu_bias at gyro");
  ASSERT_EQ(with.effects.back().values.size(), 3U);
  EXPECT_EQ(with.effects.back().values[0].uncertainty, 0.02);
  EXPECT_EQ(with.effects.back().values[1].uncertainty, 0.0);
  EXPECT_EQ(with.effects.back().values[2].uncertainty, 0.02);
  EXPECT_EQ(with_zero_errors(with, data).effects.size(), before + 1);
}

/// MABEL's hops 31 and 32 as the robot's sensors recorded them.
class MeasuredHops : public testing::Test {
 protected:
  static constexpr const char* kTrials = PLUMBLINE_ROOT "/validation/trials/mabel_hops/hop_";

  MeasuredHops() {
    for (const char* hop : {"31", "32"}) {
      trials_.push_back(read_trial(std::string(kTrials) + hop, model_));
    }
  }

  /// Mean and range of a foot's depth between two instants of a trial, m.
  struct Depth {
    double mean, range;
  };
  static Depth depth(const model::Model& model, const Trial& trial, int foot, double from, double to) {
    Predictor predictor(model, trial, {});
    const Eigen::MatrixXd positions = predictor.measured_positions();
    Eigen::VectorXd x = Eigen::VectorXd::Zero(predictor.plant().states());
    std::vector<double> depths;
    for (Eigen::Index k = 0; k < trial.samples(); ++k) {
      if (trial.time[k] >= from && trial.time[k] <= to) {
        x.head(positions.rows()) = positions.col(k);
        depths.push_back(predictor.plant().foot_depth(foot, x.data()).depth);
      }
    }
    const auto [low, high] = std::minmax_element(depths.begin(), depths.end());
    return {std::accumulate(depths.begin(), depths.end(), 0.0) / static_cast<double>(depths.size()),
            *high - *low};
  }

  const model::Model model_ =
      model::read_model(PLUMBLINE_ROOT "/robots/mabel/mabel_measured.yaml", model::known_effects());
  std::vector<Trial> trials_;
};

// In the second half of a stance both feet stand. As recorded they float 20 to 30 mm above the floor, and the
// right one drifts while its knee bends.
TEST_F(MeasuredHops, FeetStandStillOnTheFloor) {
  const model::Model model = with_zero_errors(model_, Data(trials_, {}));
  for (const int foot : {0, 1}) {
    const Depth recorded = depth(model_, trials_.front(), foot, 21.50, 21.62);
    const Depth corrected = depth(model, trials_.front(), foot, 21.50, 21.62);
    EXPECT_LT(recorded.mean, -0.02) << foot;
    EXPECT_NEAR(corrected.mean, 0.0, 0.004) << foot;
    EXPECT_LT(corrected.range, 0.008) << foot;
  }
}

// 6 deg at a knee are 94 deg of its motor: a motor's encoder is zeroed against the joint, and the cable
// between them stays as stretched as it was recorded.
TEST_F(MeasuredHops, CablesStayAsStretchedAsRecorded) {
  const model::Model model = with_zero_errors(model_, Data(trials_, {}));
  const auto stretches = [&](const model::Model& one) {
    Predictor predictor(one, trials_.front(), {});
    return Eigen::VectorXd(predictor.plant().stretch_map() * predictor.measured_positions().col(100));
  };
  double largest = 0.0;
  for (const model::EffectUse& use : model.effects) {
    if (use.law->declaration().name == "encoder_offset" && use.at == "mLS_right") {
      largest = std::abs(use.values.front().value);
    }
  }
  EXPECT_GT(largest, 1.0);
  EXPECT_LT((stretches(model) - stretches(model_)).cwiseAbs().maxCoeff(), 1e-6);
}

}  // namespace
}  // namespace plumbline::validation
