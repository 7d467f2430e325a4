// MABEL's leg on the bench and twins of its three experiments, for the tests of this folder.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "validation/diagnose/diagnose.h"

namespace plumbline::validation {

model::Model bench();

/// Two trials to train on and one held out, recorded from the bench with these effects ("law@place:p=1") in
/// it.
Data bench_twins(const std::vector<std::string>& hidden);

/// A small catalogue: the trial of every law would take minutes.
effects::Catalogue some_laws(const std::set<std::string>& names);

/// The model as it is, with the windows' initial states fitted.
Stage as_given(const model::Model& model, const Data& data);

}  // namespace plumbline::validation
