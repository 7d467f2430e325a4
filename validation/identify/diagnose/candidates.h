// Every (effect, place) that a model could be missing.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "validation/identify/predict/estimate.h"

namespace plumbline::validation {

struct Candidate {
  std::shared_ptr<const effects::Law> law;
  effects::Place place = effects::Place::coordinate;
  std::string at;
  std::vector<std::string> same_places;  ///< rigidly tied to `at`: the law there is the same law
  effects::Scales scales;                ///< typical magnitudes at the place
  /// Parameters without any effect on this model, as a shift of mass across the plane in which it moves.
  std::vector<int> without_effect{};
  std::string label() const { return law->declaration().name + "@" + at; }
};

/// All laws at all their places that the trials can move. Force laws at places that the rigid drivetrain
/// ties together (motor and its coordinate) are one candidate, named by the motor.
/// `estimate` gives the motion of the train windows under the model.
std::vector<Candidate> list_candidates(PredictorPool& pool, const effects::Catalogue& catalogue,
                                       const std::vector<FreeParameter>& parameters,
                                       const Estimate& estimate);

/// Values from which the candidate is tried: those of its law, but that what hangs on a body begins where the
/// body's own mass is.
std::vector<effects::Values> starts_of(const model::Model& model, const Candidate& candidate);

/// A use of the candidate's law with these values.
model::EffectUse make_use(const Candidate& candidate, const effects::Values& values);

/// The law's parameters that a fit may move, for the effect at index `effect` of a model.
std::vector<FreeParameter> free_parameters_of(const model::EffectUse& use, int effect,
                                              const effects::Scales& scales, bool angular);

/// The same for a use of a candidate that is searched, the effect at index `effect` of the model: within what
/// is physical, without what has no effect, its rest lies near the motion, and a drive is no softer than the
/// root mean square of its force over half the range of its motion. Seen from far away every law of a
/// distance is a constant, and would be another law under this name.
std::vector<FreeParameter> searched_parameters_of(const model::Model& model, const Candidate& candidate,
                                                  int effect);

Eigen::VectorXd values_of(const model::Model& model, const std::vector<FreeParameter>& parameters);

/// The model with the parameters set. A law that brings states (bristles, a released ratio) and was not null
/// does not become it: initial states found with the model fit the one that is returned.
model::Model with_values(model::Model model, const std::vector<FreeParameter>& parameters,
                         const Eigen::VectorXd& theta);

}  // namespace plumbline::validation
