// Numbers to text and back, without the locale.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace plumbline {

/// The whole text as a decimal number, a leading plus allowed; "inf" and "nan" are no numbers here.
std::optional<double> parse_number(std::string_view text);

/// The shortest text that reads back as the same double; infinity is ".inf" as in YAML.
std::string number_text(double value);

/// With so many significant digits.
std::string number_text(double value, int digits);

}  // namespace plumbline
