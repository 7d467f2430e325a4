// Units of numbers that cross a file boundary (udunits2 underneath). Inside, everything is SI and rad.
#pragma once

#include <string>

namespace plumbline {

/// True when udunits2 can read the text ("N m s/rad", "deg", "count", "1", "kg m^2").
bool unit_is_known(const std::string& unit);

/// True when both have one dimension (rad counts as dimensionless).
bool units_agree(const std::string& a, const std::string& b);

/// factor and offset: value_SI = factor * value + offset. Throws InputError on unknown units.
double to_si_factor(const std::string& unit);

}  // namespace plumbline
