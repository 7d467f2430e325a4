// How far into its windows a model can be followed.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "validation/predict/problem.h"

namespace plumbline::validation {

/// Share of every window's length over which the model can be followed: over longer ones the search of the
/// initial states ends above the floor and does not settle in more than a tenth of the windows, since through
/// contact, stops and play what a wrong model predicts departs from the measurements without a way back, and
/// slopes there promise what no step keeps. Where most of their length can be followed, windows that are
/// found by their parts (states_by_parts.h) are not lost. 1 where windows are linear in where they begin.
double reach(const model::Model& model, const Data& data);

/// The same from where it is known: `part` of the windows' length has been followed, from the initial states
/// x0. At least `part`.
double reach_further(const model::Model& model, const Data& data, double part,
                     const std::vector<Eigen::VectorXd>& x0);

/// Windows as far as a model can be followed, and where they begin.
struct Followed {
  Data data;
  std::vector<Eigen::VectorXd> x0;  ///< empty for a model without stops or play
};

/// Of a window whose initial state's next step promises the floor while no step leads there, the beginning
/// that was at the floor: what is behind it depends on where it begins more finely than can be searched, and
/// no model can be held against it. A window that the model misses without such a promise stays as it is:
/// that is evidence.
Followed follow(const model::Model& model, const Data& data);

/// The next longer part of the windows, at most 1.
double longer_part(double share);

}  // namespace plumbline::validation
