// The section `correlations` of a model file.
#pragma once

#include <string>

#include "simulator/model/model.h"
#include "simulator/model/yaml_node.h"

namespace plumbline::model {

/// correlations: {of: [labels], below_diagonal: [[r21], [r31, r32], ...]}, in place of what the base says
/// of these values. Needs the effects with their values. Throws InputError on labels that the model does not
/// have or that state no uncertainty, on rows of another length, and where the matrix is not positive
/// definite.
void read_correlations(const YamlNode& node, Model& model);
/// The section as text, six digits to an entry.
std::string correlations_text(const Correlations& correlations);

/// Of values that the model has, and of which it states an uncertainty; those of one value alone are none.
Correlations correlations_of_uncertain(const Correlations& all, const Model& model);

}  // namespace plumbline::model
