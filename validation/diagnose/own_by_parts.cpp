#include "validation/diagnose/own_by_parts.h"

#include <stdexcept>

#include "validation/diagnose/candidates.h"
#include "validation/diagnose/own_parameters.h"
#include "validation/predict/reach.h"

namespace plumbline::validation {
namespace {

Estimate fit(const model::Model& model, const std::vector<FreeParameter>& parameters,
             const std::vector<Eigen::VectorXd>& x0, const Data& data) {
  PredictorPool pool(model, data);
  return gauss_newton(pool, parameters, values_of(model, parameters), x0, {10, 1e-4});
}

/// The stage's values on other beginnings of the windows, and the numbers that can be told there beside them.
Stage fitted_further(const Stage& before, double width, const Data& data,
                     const std::vector<Eigen::VectorXd>& x0) {
  Stage stage{fitted_model(before), before.parameters, {}};
  stage.estimate = fit(stage.model, stage.parameters, x0, data);
  const Stage open = with_open_numbers(stage, 0, width, data);
  return open.parameters.size() > stage.parameters.size() ? fit_open_numbers(open, data) : stage;
}

}  // namespace

Stage fit_open_numbers(const Stage& open, const Data& data) {
  return {open.model, open.parameters, fit(open.model, open.parameters, open.estimate.x0, data)};
}

Stage fit_own_by_parts(const Stage& given, double part, double width, const Data& data) {
  try {
    Stage stage{given.model, given.parameters, given.estimate};
    double share = longer_part(0.0);
    while (share < part) {
      const Followed followed = follow(fitted_model(stage), data.beginnings(share / part));
      stage = fitted_further(stage, width, followed.data, followed.x0);
      share = longer_part(share);
    }
    return fitted_further(stage, width, data, follow(fitted_model(stage), data).x0);
  } catch (const Stopped&) {
    throw;
  } catch (const std::runtime_error&) {
    return given;
  }
}

}  // namespace plumbline::validation
