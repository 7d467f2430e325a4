// What ordinary identification frees first, as one hypothesis: the commonest truth about a real robot, and
// one that a search for one effect at a time meets late.
#pragma once

#include <optional>
#include <vector>

#include "validation/identify/diagnose/look_ahead.h"

namespace plumbline::validation {

/// Several effects that were fitted at once, in the order in which they stand at the end of the model.
struct Group {
  std::vector<Candidate> candidates;
  Stage stage;
  double share = 0.0;  ///< of the resamples in which it predicts better than the best single effect
};

/// Viscous and Coulomb friction at as many places as the robot moves independently, motors first, fitted at
/// once from the stage that `tried` began from; then rotor inertia, torque constant and offset of every motor
/// beside them, which is taken where the error that counts falls by Policy::material more, in most of the
/// resamples. Those whose value is within two deviations of nothing or at a physical limit are taken out, and
/// the others fitted anew, until all stay. What the stage has open already is not added again. Nothing where
/// fewer than two are left, or where the error that counts is not at least a fifth below that of the best
/// single effect. Where none was refitted yet it must take three quarters of the squared error, and leave
/// less than any single effect promises.
std::optional<Group> standard_effects(const Tried& tried, const Data& data, const Policy& policy,
                                      const Progress& progress);

}  // namespace plumbline::validation
