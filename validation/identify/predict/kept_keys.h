// What estimates and searches of states depend on, and estimates as numbers.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "validation/identify/predict/estimate.h"
#include "validation/identify/predict/kept_results.h"

namespace plumbline::validation {

/// `what` is done with a model on data. Of the model its effects and their values, of the data the windows
/// and how they are predicted: all else is in the files from which both were read.
ResultKey key_of(const std::string& what, const model::Model& model, const Data& data);

void add_parameters(const std::vector<FreeParameter>& parameters, ResultKey& key);

/// The result that is kept for the data under this key; else what `compute` returns, which is kept if the
/// data keeps results at all.
Record kept(const Data& data, const ResultKey& key, const std::function<Record()>& compute);

Record record_of(const Estimate& estimate);
Estimate estimate_from(const Record& record);

}  // namespace plumbline::validation
