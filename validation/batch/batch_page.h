// What all rows of a batch say together, as one page and as a table.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace plumbline::batch {

/// One HTML page that needs nothing beside it: which effects where, values with intervals over robots and
/// days, what drifts, and every row. The same rows give the same bytes.
std::string page_of(const std::string& title, const std::vector<nlohmann::json>& rows);

/// One line for each value of each row, a row without values has one line; RFC 4180.
std::string csv_of(const std::vector<nlohmann::json>& rows);

}  // namespace plumbline::batch
