// Counts that are lost: what a window in the midst of a record begins with.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tests/limits/bench.h"
#include "validation/identify/predict/windows.h"

namespace plumbline::limits {
namespace {

class LostCountsOfARecord : public testing::Test {
 protected:
  model::Model model_ = with_effect(leg_bench(), "lost_counts", "mLA", {0.1, 6.0, 0.05});
  validation::Experiment experiment_ = both_motors(model_, 2.0);
  validation::Trial trial_ = validation::twin(model_, experiment_, {});
  run::CommandedRun run_ = simulate(model_, experiment_, options_at(1e-9));
};

// The state is the motor's true position and what the encoder shows of it, taken apart.
TEST_F(LostCountsOfARecord, AreWhatTheReadingLacks) {
  model::Plant plant(model_, {});
  const int sensor = model_.sensor_index("mLA");
  const Eigen::Index last = run_.states.cols() - 1;
  const double lost = run_.states(plant.states() - 1, last);
  const double actual = plant.position_of("mLA", run_.states.col(last).data());
  EXPECT_GT(run_.states.row(plant.states() - 1).cwiseAbs().maxCoeff(), 0.05) << "rad";
  EXPECT_NEAR(run_.outputs(sensor, last), actual + lost, 1e-12);
  EXPECT_EQ(plant.state_names().back(), "lost of lost_counts at mLA");
}

// From the readings alone, as they were made with quantisation, without their noise of a derivative: to a
// share of what was lost.
TEST_F(LostCountsOfARecord, AreCarriedFromWhereItBegins) {
  validation::Predictor predictor(model_, trial_, {});
  const Eigen::Index state = predictor.plant().states() - 1;
  const double most = run_.states.row(state).cwiseAbs().maxCoeff();
  for (const Eigen::Index first : {0L, 700L, 1400L}) {
    const validation::Window window{0, first, 100, {}};
    predictor.residual(window, predictor.initial_state(window));
    EXPECT_NEAR(predictor.predicted_states()(state, 0), run_.states(state, first), 0.01 * most) << first;
  }
}

// At the truth a late window is left with no more than what carrying leaves: 3.3 floors where 1 % were the
// limit.
TEST_F(LostCountsOfARecord, LeaveLittleAtTheTruth) {
  validation::Predictor predictor(model_, trial_, {});
  const validation::Window window{0, 1400, 300, {}};
  const Eigen::VectorXd r = predictor.residual(window, run_.states.col(1400));
  const double most = run_.states.row(predictor.plant().states() - 1).cwiseAbs().maxCoeff();
  const double limit = 0.01 * most / predictor.floors()[0];
  std::printf("lost at most %.3f rad; left %.2f floors, limit %.2f\n", most,
              r.norm() / std::sqrt(static_cast<double>(r.size())), limit);
  EXPECT_LT(r.norm() / std::sqrt(static_cast<double>(r.size())), limit);
}

}  // namespace
}  // namespace plumbline::limits
