// A cube that bounces on a table, and no switch that says when: windows through several impacts.
#include <gtest/gtest.h>

#include <cmath>

#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"
#include "simulator/run/commanded_run.h"
#include "tests/trace/temporary_folder.h"
#include "validation/identify/predict/contact_changes.h"
#include "validation/identify/predict/estimate.h"
#include "validation/identify/predict/reach.h"

namespace plumbline::validation {
namespace {

constexpr const char* kCube = R"(<mujoco><option gravity="0 0 -9.81"/><worldbody>
  <body name="cube"><joint name="along" type="slide" axis="1 0 0"/><joint name="up" type="slide" axis="0 0 1"/>
    <joint name="turn" axis="0 1 0"/>
    <inertial pos="0 0 0" mass="0.37" diaginertia="6.8e-4 6.8e-4 6.8e-4"/>
  </body></worldbody></mujoco>)";
constexpr const char* kModel = R"(plumbline: model/1
robot: cube in a plane
skeleton: cube.xml
coordinates: {along: {of: {along: 1}}, up: {of: {up: 1}}, turn: {of: {turn: 1}}}
feet: {cube: {link: cube, value: [0, 0, 0], unit: m, box: [0.105, 0.1, 0.105], assumed: t}}
sensors:
  along: {measures: along, resolution: {value: 2e-5, unit: m, assumed: t}, assumed: t}
  up: {measures: up, resolution: {value: 2e-5, unit: m, assumed: t}, assumed: t}
  turn: {measures: turn, resolution: {value: 1e-4, unit: rad, assumed: t}, assumed: t}
effects:
  - effect: ground_normal
    at: cube
    values: {stiffness: {value: 1e5, unit: N, assumed: t}, damping: {value: 6e4, unit: N s/m, assumed: t}}
  - effect: ground_coulomb
    at: cube
    values: {friction: {value: 0.3, unit: '1', assumed: t}, slip_speed: {value: 0.02, unit: m/s, assumed: t}}
)";
constexpr double kPeriod = 0.002;
constexpr Eigen::Index kSamples = 501;

class Impacts : public testing::Test {
 protected:
  Impacts() {
    folder_.write("cube.xml", kCube);
    model_ = model::read_model(folder_.write("model.yaml", kModel), model::known_effects());
  }
  /// The cube let go at a height and a turn, as its sensors count it.
  Trial dropped(double height, double turn) const {
    model::Plant plant(model_, {});
    Eigen::VectorXd x0 = Eigen::VectorXd::Zero(plant.states());
    x0[1] = height;
    x0[2] = turn;
    x0[3] = 0.3;
    x0[5] = 2.0;
    run::CommandedOptions options;
    options.integrator.method = integrate::Method::rosenbrock;
    options.integrator.set_tolerance(1e-8);
    const run::CommandedRun run =
        run::run_commands(plant, x0, Eigen::MatrixXd::Zero(0, kSamples), kPeriod, 0.0, {}, nullptr, options);
    Trial trial;
    trial.name = "dropped";
    trial.period = kPeriod;
    trial.time = run.time;
    for (std::size_t s = 0; s < model_.sensors.size(); ++s) {
      const double count = model_.sensors[s].resolution;
      Measured channel;
      channel.sensor = model_.sensors[s].name;
      channel.values = (run.outputs.row(static_cast<Eigen::Index>(s)).transpose() / count).array().round();
      channel.values *= count;
      trial.measured.push_back(channel);
    }
    return trial;
  }

  test::TemporaryFolder folder_;
  model::Model model_;
};

// The model is the one that made the recordings: what is left is what counts leave. A search over whole
// windows ends in minima of other orders of impacts, tens of floors away.
TEST_F(Impacts, WindowsOfTheTrueModelComeToTheFloor) {
  const Data data({dropped(0.2, -0.5), dropped(0.25, 0.4)}, {});
  ASSERT_EQ(data.windows.size(), 4U);
  PredictorPool pool(model_, data);
  const Estimate estimate = estimate_states(pool);
  EXPECT_LT(estimate.scores.train, 1.1);
  EXPECT_GT(estimate.scores.train, 0.8);
}

// A ground that is 0.03 % too stiff leaves a little above the floor, and no step of the state promises less:
// the windows are followed to their end.
TEST_F(Impacts, AWindowWithALittleLeftIsNotCut) {
  const Data data({dropped(0.2, -0.5), dropped(0.25, 0.4)}, {});
  model::Model stiffer = model_;
  stiffer.effects[0].values[0].value *= 1.0003;
  PredictorPool pool(stiffer, data);
  const double error = estimate_states(pool).scores.train;
  ASSERT_GT(error, 1.2);
  ASSERT_LT(error, 1.5);
  EXPECT_EQ(not_followed(data, follow_at(stiffer, data, data.predict.window)), 0U);
}

TEST_F(Impacts, AreSeenInThePrediction) {
  const Trial trial = dropped(0.2, -0.5);
  Predictor predictor(model_, trial, {});
  const Window fall{0, 0, 40, {}};
  predictor.predict(fall, predictor.initial_state(fall));
  EXPECT_FALSE(do_contacts_change(predictor));
  const Window landing{0, 0, 200, {}};
  predictor.predict(landing, predictor.initial_state(landing));
  EXPECT_TRUE(do_contacts_change(predictor));
}

}  // namespace
}  // namespace plumbline::validation
