#include "validation/identify/diagnose/judged.h"

namespace plumbline::validation {

double judged(const Estimate& estimate, const Data& data) {
  return data.has(Role::held_out) ? estimate.predicted.scores.held_out : estimate.scores.train;
}

double judged(const Scores& scores, const Data& data) {
  return data.has(Role::held_out) ? scores.held_out : scores.train;
}

bool is_below(double limit, const Estimate& estimate, const Data& data) {
  return judged(estimate, data) < limit && estimate.scores.train < limit;
}

}  // namespace plumbline::validation
