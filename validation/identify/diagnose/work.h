// How much work a model is to predict.
#pragma once

#include "validation/identify/predict/problem.h"

namespace plumbline::validation {

/// Rate evaluations for each sample, over some windows of the data, each from where the measurements say that
/// it begins; infinite where the model cannot be integrated there within Data::predict's limits.
double work_of(const model::Model& model, const Data& data);

}  // namespace plumbline::validation
