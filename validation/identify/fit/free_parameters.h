// Which parameters a fit may move, and by what names a person chooses them.
#pragma once

#include <string>
#include <vector>

#include "validation/identify/predict/problem.h"

namespace plumbline::validation {

/// Every parameter of the model's effects that is not structural, named as overlays name it
/// ("viscous@mLA:damping", the second at a place "hard_stop@knee#2:position"), free within the law's bounds.
std::vector<FreeParameter> free_parameters(const model::Model& model);

/// Those that match at least one of the patterns (shell wildcards: * ? []). Throws InputError with the names
/// when a pattern matches none.
std::vector<FreeParameter> matching(const std::vector<FreeParameter>& parameters,
                                    const std::vector<std::string>& patterns);

/// Throws InputError when a parameter belongs to an effect that is at its null values and would change the
/// number of states when it leaves them: a fit cannot start there.
void check_can_move(const model::Model& model, const std::vector<FreeParameter>& parameters);

/// Magnitudes that matter: the value itself, or what the motion of the train trials says: for a value of
/// zero, and of logarithmic scale, where the value says how sharp a law is, not what samples can show of
/// that.
void set_typical(const model::Model& model, const Data& data, std::vector<FreeParameter>& parameters);

}  // namespace plumbline::validation
