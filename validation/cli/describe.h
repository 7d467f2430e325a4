// What a model or a trial is, in words.
#pragma once

#include "validation/api/describing.h"

namespace plumbline::cli {

using api::Freedom;

void print(const model::Model& model, const Freedom& freedom);
void print(const validation::Trial& trial, const model::Model& model, const Freedom& freedom);

}  // namespace plumbline::cli
