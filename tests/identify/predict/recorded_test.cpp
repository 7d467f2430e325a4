// What a trial says of its own recording reaches the prediction: floors, gaps, rate channels, a payload.
#include <gtest/gtest.h>

#include <cmath>

#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"
#include "validation/identify/fit/free_parameters.h"
#include "validation/identify/predict/windows.h"

namespace plumbline::validation {
namespace {

class Recorded : public testing::Test {
 protected:
  Recorded()
      : model_(model::read_model(std::string(PLUMBLINE_ROOT) + "/tests/robots/pendulum/model.yaml",
                                 model::known_effects())) {
    model::Sensor gyro;
    gyro.name = "gyro";
    gyro.measures = "shoulder";
    gyro.rate = true;
    gyro.noise = 0.01;
    model_.sensors.push_back(gyro);
    trial_.time = Eigen::VectorXd::LinSpaced(400, 0.0, 0.399);
    trial_.period = 1e-3;
    for (const char* sensor : {"shoulder", "gyro"}) {
      Measured measured;
      measured.sensor = sensor;
      measured.values = Eigen::VectorXd::Zero(400);
      trial_.measured.push_back(measured);
    }
    Command command;
    command.motor = "drive";
    command.values = (40.0 * trial_.time.array()).sin();
    trial_.commands = {command};
  }

  Eigen::VectorXd start(Predictor& predictor) const {
    Eigen::VectorXd x0 = Eigen::VectorXd::Zero(predictor.plant().states());
    x0[0] = 0.3;
    x0[predictor.plant().positions()] = 1.0;
    return x0;
  }

  model::Model model_;
  Trial trial_;
  const Window window_{0, 0, 200, {}};
};

TEST_F(Recorded, ARateChannelIsTheDerivativeOfItsPosition) {
  Predictor predictor(model_, trial_, {});
  const Eigen::MatrixXd y = predictor.predict(window_, start(predictor));
  for (Eigen::Index k = 1; k + 1 < window_.count; ++k) {
    EXPECT_NEAR(y(k, 1), (y(k + 1, 0) - y(k - 1, 0)) / 2e-3, 2e-3 * std::abs(y(k, 1)) + 1e-3) << k;
  }
  EXPECT_GT(y.col(1).cwiseAbs().maxCoeff(), 0.5);
}

TEST_F(Recorded, ItsDerivativesAreThoseByDifferences) {
  const std::vector<FreeParameter> free = matching(free_parameters(model_), {"viscous@drive:damping"});
  PredictOptions by_differences;
  by_differences.differences = true;
  Predictor one(model_, trial_, {});
  Predictor other(model_, trial_, by_differences);
  const Linearisation a = one.linearise(window_, start(one), free);
  const Linearisation b = other.linearise(window_, start(other), free);
  EXPECT_LT((a.Jx - b.Jx).norm(), 1e-2 * b.Jx.norm());
  EXPECT_LT((a.Jp - b.Jp).norm(), 2e-2 * b.Jp.norm());
}

TEST_F(Recorded, FloorsAreTheTrials) {
  trial_.measured[0].resolution = 0.6;
  trial_.measured[0].noise = 0.1;
  const Predictor predictor(model_, trial_, {});
  EXPECT_NEAR(predictor.floors()[0], 0.2, 1e-12);
  EXPECT_NEAR(predictor.floors()[1], 0.01, 1e-12);
}

// The payload is in the trial or in the model: the same motion.
TEST_F(Recorded, APayloadOfTheTrialAloneActsAsOneOfTheModel) {
  const std::string place = model_.skeleton.bodies.back().name;
  model::EffectUse payload;
  payload.law = model::known_effects().find("added_mass");
  payload.at = place;
  payload.values.resize(static_cast<std::size_t>(payload.law->parameter_count()));
  payload.values[static_cast<std::size_t>(payload.law->parameter_index("mass"))].value = 0.4;
  Predictor bare(model_, trial_, {});
  const Eigen::MatrixXd without = bare.predict(window_, start(bare));
  trial_.configuration = {payload};
  Predictor carried(model_, trial_, {});
  Trial plain = trial_;
  plain.configuration.clear();
  model::Model heavy = model_;
  heavy.effects.push_back(payload);
  Predictor built_in(heavy, plain, {});
  const Eigen::MatrixXd with = carried.predict(window_, start(carried));
  EXPECT_EQ((with - built_in.predict(window_, start(built_in))).norm(), 0.0);
  EXPECT_GT((with - without).norm(), 1e-3);
}

TEST_F(Recorded, WindowsStayInTheirStretches) {
  trial_.stretches = {{10, 150}, {150, 155}, {200, 400}};
  PredictOptions options;
  options.window = 0.05;
  const std::vector<Window> windows = cut_windows({trial_}, options);
  Eigen::Index samples = 0;
  for (const Window& window : windows) {
    const Eigen::Index end = window.first + window.count;
    EXPECT_TRUE((window.first >= 10 && end <= 150) || (window.first >= 200 && end <= 400))
        << window.first << " to " << end;
    samples += window.count;
  }
  EXPECT_EQ(samples, 140 + 200);  // five samples are too few for a window
}

}  // namespace
}  // namespace plumbline::validation
