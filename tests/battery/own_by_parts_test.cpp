// Two hops of a MABEL with other numbers than stated: over a third of a window the error has many minima.
#include "validation/diagnose/own_by_parts.h"

#include <gtest/gtest.h>

#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"
#include "tests/battery/draw.h"
#include "tests/battery/truth.h"
#include "validation/diagnose/diagnose.h"
#include "validation/diagnose/own_parameters.h"
#include "validation/predict/reach.h"

namespace plumbline::battery {
namespace {

using validation::Data;
using validation::Stage;

constexpr unsigned kSeed = 3002;
constexpr double kPart = 0.35;

/// The model as given on beginnings of the windows, which it loses there.
struct Beginnings {
  Data data;
  Stage given;
};

Beginnings beginnings(std::size_t most_windows) {
  RunOptions options;
  options.seed = kSeed;
  const Case one = case_of("mabel/none/2");
  const model::Model model =
      model::read_model(PLUMBLINE_ROOT "/" + robot_of(one).model, model::known_effects());
  Draw draw(one, kSeed);
  const Truth truth = truth_of(one, model, draw, options);
  const Data hops(trials_of(one, model, truth, draw, options), {});
  const validation::Followed followed =
      validation::follow(model, hops.thinned(most_windows).beginnings(kPart));
  validation::PredictorPool pool(model, followed.data);
  return {followed.data, {model, {}, estimate_states(pool, followed.x0)}};
}

TEST(OwnByParts, ReachTheFloorWhereAFitToAllAtOnceEndsBesideIt) {
  const validation::DiagnoseOptions limits;
  const auto [data, given] = beginnings(limits.windows);
  EXPECT_GT(given.estimate.scores.train, 5.0);
  const Stage open = with_open_numbers(given, 0, limits.parameter_width, data);
  EXPECT_GT(fit_open_numbers(open, data).estimate.scores.train, 2.0);
  const Stage fitted = fit_own_by_parts(given, kPart, limits.parameter_width, data);
  EXPECT_LT(fitted.estimate.scores.train, 1.1);
  EXPECT_LT(fitted.estimate.scores.held_out, 1.2);
}

}  // namespace
}  // namespace plumbline::battery
