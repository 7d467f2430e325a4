// The catalogue as a table for readers, made from the laws' declarations.
#pragma once

#include <string>

#include "simulator/effects/catalogue.h"

namespace plumbline::effects {

/// Markdown table, one row for each law: effect, places, equation, parameters (unit, null value, bounds),
/// states, energy note, source. Ends with a line break.
std::string documentation_table(const Catalogue& catalogue);

/// "N m s/rad or N s/m"; one unit when rotary and linear places have the same.
std::string unit_in_words(const std::string& general_unit);

}  // namespace plumbline::effects
