#include "validation/diagnose/own_by_parts.h"

#include <stdexcept>

#include "validation/diagnose/candidates.h"
#include "validation/diagnose/own_parameters.h"
#include "validation/predict/reach.h"

namespace plumbline::validation {
namespace {

constexpr double kTolerance = 1e-4;

/// The stage's values on other beginnings of the windows, and the numbers that can be told there beside them.
Stage fitted_further(const Stage& before, double width, const Data& data,
                     const std::vector<Eigen::VectorXd>& x0) {
  const Stage stage = fitted_anew({fitted_model(before), before.parameters, {}}, data, x0, kTolerance);
  const Stage open = with_open_numbers(stage, 0, width, data);
  return open.parameters.size() > stage.parameters.size() ? fit_open_numbers(open, data) : stage;
}

}  // namespace

Stage fit_open_numbers(const Stage& open, const Data& data) {
  return fitted_anew(open, data, open.estimate.x0, kTolerance);
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
