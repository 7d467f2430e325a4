// Zero errors of a record's sensors: constants that an estimate may move, as nuisance and not as physics.
#pragma once

#include "validation/identify/predict/problem.h"

namespace plumbline::validation {

/// The model with an encoder_offset of uncertain value at every sensor for which a trial states an
/// `offset_uncertainty` (of several the smallest), so that they are free beside the other model parameters;
/// at a gyroscope or an accelerometer of three axes with an imu_bias. Where the model has feet and no contact
/// switch was recorded, the offsets begin where the recorded motion has stood: no slope leads a foot to a
/// ground that it never reaches. With d_f the depth that foot f reaches in all but the deepest samples, as
/// the sensors say, r_f the depth at rest, J = d(d_f)/d(offsets) and S = diag(offset_uncertainty^2),
///   offsets = S J' (J S J' + s^2 I)^-1 (r - d),  s = 1 mm,
/// the smallest offsets, each in units of its uncertainty, that put the feet on the ground. A foot that
/// never stands, for which the depths near the deepest are few, is left out. From there the feet are held
/// still through every stance (offsets_of_standing_feet). A motor's encoder is zeroed against the joints that
/// it drives: where joints' zeros move, motors' zeros follow, so that cables and springs stay as stretched as
/// they were recorded, and `offset_uncertainty` of a motor is how well that was done.
model::Model with_zero_errors(const model::Model& model, const Data& data);

}  // namespace plumbline::validation
