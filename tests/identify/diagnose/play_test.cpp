// Fits where the error over a window has many minima, and what is said of values that the data do not see.
#include <gtest/gtest.h>

#include "tests/identify/diagnose/bench.h"
#include "tests/identify/predict/hopper.h"
#include "validation/identify/diagnose/candidates.h"
#include "validation/identify/diagnose/look_ahead.h"
#include "validation/identify/fit/free_parameters.h"
#include "validation/identify/predict/deviations.h"
#include "validation/identify/twin/twin.h"

namespace plumbline::validation {
namespace {

struct Fitted {
  model::Model model;
  std::vector<FreeParameter> parameters;
  Estimate estimate;
};

/// The parameters of `effect` fitted from the values it is given with.
Fitted fitted(const std::string& effect, const std::string& pattern, const Data& data) {
  Fitted one;
  one.model = bench();
  one.model.effects.push_back(parse_effect(effect, one.model, effects::Catalogue::all()));
  one.parameters = matching(free_parameters(one.model), {pattern});
  PredictorPool pool(one.model, data);
  one.estimate = gauss_newton(pool, one.parameters, values_of(one.model, one.parameters), {}, {12, 1e-3});
  return one;
}

// Over whole windows alone the fit ends at a gap of 0.151 rad and an error of seven floors.
TEST(Play, IsFittedFromFarAway) {
  const Data data = bench_twins({"backlash@leg_shape:gap=0.162,stiffness=117,damping=0.111"}).thinned(6);
  const Fitted found = fitted("backlash@leg_shape:gap=0.12,stiffness=150,damping=0.2", "backlash@*", data);
  EXPECT_NEAR(found.estimate.theta[0], 0.162, 0.002);
  EXPECT_NEAR(found.estimate.theta[1], 117.0, 4.0);
  EXPECT_NEAR(found.estimate.theta[2], 0.111, 0.005);
}

// No sensor sees the hopper's carriage, and beside the motor alone its contact is far stiffer than 60 Hz.
TEST(Play, IsFoundWhereNoSensorSeesItsDrivenSide) {
  const Data data = hopper_twins("backlash@carriage:gap=0.0043,stiffness=1750,damping=0.06").thinned(4);
  const Stage stage = as_given(test::hopper(), data);
  const Tried tried = try_candidates(stage, some_laws({"backlash"}), {}, data, {}, silent);
  const Refit& found = first_of("backlash@carriage", tried.refits, tried.candidates);
  EXPECT_LT(found.estimate.scores.train, 1.3) << "floors";
}

// What play leaves moves a bristle friction a little further at every step, to no end.
TEST(GaussNewton, EndsWhereItOnlyCreeps) {
  const Data data = bench_twins({"backlash@leg_shape:gap=0.162,stiffness=117,damping=0.111"}).thinned(4);
  const Fitted found = fitted("lugre@thigh:level=0.3,stiffness=30,viscous=1e-2", "lugre@*", data);
  EXPECT_TRUE(found.estimate.converged);
}

// Without a rise of the friction at low speed nothing tells over which speed it fades.
TEST(Deviations, OfAValueThatNothingTellsAreWide) {
  const Data data = bench_twins({"coulomb@mLA:level=0.005,smoothing_speed=0.03"}).thinned(6);
  Fitted found =
      fitted("stribeck@mLA:level=0.004,rise=0.001,stribeck_speed=4,smoothing_speed=0.03", "stribeck@*", data);
  found.estimate.theta[1] = 0.0;
  PredictorPool pool(found.model, data);
  const Eigen::VectorXd deviations =
      precision_of(pool, data.windows_of(Role::train), found.parameters, found.estimate).deviations;
  EXPECT_GT(deviations[2], 3.0 * found.estimate.theta[2]);
  EXPECT_LT(deviations[0], 0.1 * found.estimate.theta[0]);
}

}  // namespace
}  // namespace plumbline::validation
