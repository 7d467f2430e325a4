// MABEL's leg on the bench, a pendulum and a hopper, and twins of their experiments, for the tests of this
// folder.
#pragma once

#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "validation/identify/diagnose/diagnose.h"

namespace plumbline::validation {

model::Model bench();

/// Two trials to train on and one held out, recorded from the bench with these effects ("law@place:p=1") in
/// it.
Data bench_twins(const std::vector<std::string>& hidden);

/// The same of a pendulum on a geared motor.
model::Model pendulum_drive();
Data pendulum_twins(const std::vector<std::string>& hidden);

/// The hopper's two trials, recorded with this effect in it.
Data hopper_twins(const std::string& hidden);

/// A small catalogue: the trial of every law would take minutes.
effects::Catalogue some_laws(const std::set<std::string>& names);

/// Of refits or hypotheses the first whose candidate has this label ("law@place").
template <typename One>
const One& first_of(const std::string& label, const std::vector<One>& some,
                    const std::vector<Candidate>& candidates) {
  for (const One& one : some) {
    if (candidates[static_cast<std::size_t>(one.candidate)].label() == label) {
      return one;
    }
  }
  throw std::invalid_argument("nothing of " + label);
}

/// Progress that nobody sees.
inline void silent(const std::string& /*what*/, double /*fraction*/) {}

/// The model as it is, with the windows' initial states fitted.
Stage as_given(const model::Model& model, const Data& data);

}  // namespace plumbline::validation
