// Initial states of windows that are too crooked to be searched at once.
#pragma once

#include "validation/identify/predict/initial_states.h"

namespace plumbline::validation {

/// How much of each window was brought to the floor, and from which initial state.
struct Grown {
  std::vector<double> share;
  std::vector<Eigen::VectorXd> x0;
};

/// Initial states of windows with stops, play or impacts, the parameters as they are: fitted to short
/// beginnings of the windows, then longer ones, each from where the one before ended. A window that is above
/// the floor after that is also tried from the measurements at once, and the better is kept: a wrong model
/// may fit a beginning in a way that leads nowhere.
Point states_by_parts(PredictorPool& pool, const std::vector<FreeParameter>& parameters,
                      const Eigen::VectorXd& theta);

/// The same, and windows that are still above the floor, but were not on a beginning, are grown from there in
/// steps as small as it takes: a motion that runs away from what it nearly was allows only small ones. Costs
/// much where the model is wrong, for it then ends at the floor nowhere.
Point grown_states(PredictorPool& pool, const std::vector<FreeParameter>& parameters,
                   const Eigen::VectorXd& theta, Grown* how_far = nullptr);

/// estimate_states with less pains, for a model whose values are still to be searched: through contact, stops
/// and play it need not explain a window to its end.
Estimate rough_states(PredictorPool& pool);

/// Has the model stops or play, or impacts that no switch has recorded?
bool has_corners(PredictorPool& pool, const std::vector<FreeParameter>& parameters,
                 const Eigen::VectorXd& theta);

}  // namespace plumbline::validation
