// One value of all rows, drawn.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "validation/batch/values.h"

namespace plumbline::batch {

/// A colour for each robot, in the order in which rows name them; of the palette of M. Okabe and K. Ito
/// (2008), which colour-blind readers can tell apart. It begins anew behind its end.
class RobotColours {
 public:
  explicit RobotColours(const std::vector<nlohmann::json>& rows);
  std::string of(const std::string& robot) const;
  const std::vector<std::string>& names() const { return names_; }

 private:
  std::vector<std::string> names_;
};

/// SVG: a dot and an interval for each row, over days where all rows state them, else in the order of the
/// rows; a line where the value drifts; the mean with its interval behind them.
std::string drawing_of(const ValueOverRows& value, const std::vector<nlohmann::json>& rows,
                       const RobotColours& colours);

}  // namespace plumbline::batch
