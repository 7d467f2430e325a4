// Which of two laws the data speak for, when one of them has more values.
#pragma once

#include "validation/identify/diagnose/refit.h"

namespace plumbline::validation {

/// Natural logarithm of the odds for `one` against `other`, both refitted from the stage `before` (Laplace's
/// approximation of their Bayes factor):
///   (X_other - X_one) / (2 max(1, X_one / n)) + O_one - O_other,  O = sum_i log(l_i / (1 + l_i)) / 2,
/// X the sum of the n squared residuals of all windows as predicted, floor units, and l_i the eigenvalues of
/// S^-1 C S^-1 with C the covariance of the values that the refit added, all others and the initial states
/// fitted, and S = diag(s) the size that each may be expected to have. s of a strength, which has a null
/// value, is the change that alone would move the prediction as much as the refit lowered X, within the
/// value's bounds; of a shape, searched by its logarithm, a factor e. A value that could change by s
/// unnoticed costs its law nothing. Source: MacKay, Neural Computation 4 (1992) 415-447 (the Occam factor);
/// Kass and Raftery, J. American Statistical Association 90 (1995) 773-795.
double log_odds(const Stage& before, const Refit& one, const Refit& other, const Data& data);

}  // namespace plumbline::validation
