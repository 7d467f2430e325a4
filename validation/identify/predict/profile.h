// Are values as well known as the slopes at the best estimate say?
#pragma once

#include <Eigen/Core>
#include <vector>

#include "validation/identify/predict/deviations.h"

namespace plumbline::validation {

struct Profiled {
  /// Where a lower cost was met on the way, from there the best values.
  Estimate estimate;
  Precision slopes;  ///< from the slopes at the estimate
  Precision held;    ///< the same with deviations, below and above held against the cost
};

/// The deviations of the parameters `which`, held against the cost itself (profile likelihood). A deviation s
/// from the slopes foretells that the cost rises by 4 s^2 / H^-1_pp where the parameter is held two
/// deviations away and all others and the initial states are fitted anew. Where it rises by less, on either
/// side, the parameter is taken further, until it does or its bounds are met, and half of that way is the
/// deviation to this side (infinite at a bound); the longer of both is the parameter's: a law with a
/// threshold lies in a curved valley. Deviations only grow, by at most twenty search units, or of a
/// logarithmic scale to twenty times the value; what the data hardly see stays as it is.
/// Where the cost falls by more than one half there is a better estimate, from which it begins anew.
/// A parameter of logarithmic scale that slopes do not tell to a factor of e (a smoothing length below what
/// samples show) would hold the others as if it were known. Where it does as well, it is lifted to the
/// largest of 16, 4, 1, 1/4, ... times what is typical whose cost is the same to one half; and its own
/// deviation reaches up to the largest of these that the cost does not speak against, as above.
/// `at` is gauss_newton's with these parameters and this pool. Cost: two fits with one parameter held for
/// each of `which`. Source: Venzon and Moolgavkar, A method for computing profile-likelihood-based confidence
/// intervals, Applied Statistics 37 (1988) 87-94.
Profiled profile(PredictorPool& pool, const std::vector<FreeParameter>& parameters, const Estimate& at,
                 const std::vector<int>& which);

}  // namespace plumbline::validation
