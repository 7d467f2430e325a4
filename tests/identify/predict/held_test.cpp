// A prediction that has left the motion altogether is held there.
#include <gtest/gtest.h>

#include <cmath>

#include "simulator/effects/catalogue.h"
#include "simulator/model/robot_file.h"
#include "validation/identify/predict/windows.h"
#include "validation/identify/trial/trial.h"
#include "validation/identify/twin/twin.h"

namespace plumbline::validation {
namespace {

class HeldPrediction : public testing::Test {
 protected:
  const std::string folder_ = PLUMBLINE_ROOT "/tests/robots/pendulum/";
  const model::Model model_ = model::read_model(folder_ + "model.yaml", effects::Catalogue::all());
  const Trial right_ = twin(model_, read_experiment(folder_ + "experiments/chirp.yaml", model_), {});
  const Window window_{0, 100, 250};
};

TEST_F(HeldPrediction, StaysWhereItLeftAndHasNoSlopesThere) {
  Trial wild = right_;
  wild.commands[0].values *= 1e4;
  Predictor predictor(model_, wild, {});
  const Eigen::VectorXd x0 = predictor.initial_state(window_);
  const Linearisation line = predictor.linearise(window_, x0, {});
  const Eigen::MatrixXd predicted = predictor.predict(window_, x0);
  Eigen::Index last = window_.count - 1;
  while (last > 0 && predicted.row(last - 1) == predicted.row(window_.count - 1)) {
    --last;
  }
  ASSERT_GT(last, 1) << "followed for a while";
  ASSERT_LT(last, window_.count - 10);
  const auto& measured = wild.measured[0].values;
  const double range = measured.maxCoeff() - measured.minCoeff();
  const double off = std::abs(predicted(last, 0) - measured[window_.first + last]);
  EXPECT_GT(off, 10.0 * range);
  EXPECT_LT(std::abs(predicted(last - 1, 0) - measured[window_.first + last - 1]), off);
  const Eigen::Index behind = (last + 1) * predictor.channels();
  EXPECT_EQ(line.Jx.bottomRows(line.Jx.rows() - behind).norm(), 0.0);
  EXPECT_GT(line.Jx.topRows(behind).norm(), 0.0);
  EXPECT_FALSE(predictor.residual_within(window_, x0, 0.5 * line.r.squaredNorm()).has_value());
  EXPECT_TRUE(predictor.residual_within(window_, x0, 1.01 * line.r.squaredNorm()).has_value());
}

TEST_F(HeldPrediction, AnOrdinaryOneIsFollowedToItsEnd) {
  Predictor predictor(model_, right_, {});
  const Eigen::MatrixXd predicted = predictor.predict(window_, predictor.initial_state(window_));
  EXPECT_NE(predicted.row(window_.count - 1), predicted.row(window_.count - 2));
  EXPECT_EQ(predictor.predicted_states().cols(), window_.count);
}

}  // namespace
}  // namespace plumbline::validation
