#include "controllers/blocks/cascade_pd.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace plumbline::controllers {

CascadePd::CascadePd(const CascadePdGains& gains) : gains_(gains) {
  if (!std::isfinite(gains.position_gain) || !std::isfinite(gains.velocity_gain)) {
    throw std::invalid_argument("cascade_pd: the gains must be finite");
  }
  if (!(std::isfinite(gains.command_limit) && gains.command_limit >= 0.0)) {
    throw std::invalid_argument("cascade_pd: the command limit must be 0 (none) or positive");
  }
  if (!(std::isfinite(gains.period) && gains.period > 0.0)) {
    throw std::invalid_argument("cascade_pd: the period must be positive");
  }
  if (gains.difference_samples != 1 && gains.difference_samples != 2) {
    throw std::invalid_argument("cascade_pd: the velocity must be differenced over 1 or 2 samples");
  }
}

double CascadePd::command(double reference, double measured, double disturbance) noexcept {
  const int over = std::min(known_, gains_.difference_samples);
  const double velocity =
      over > 0 ? (measured - previous_[static_cast<std::size_t>(over - 1)]) / (over * gains_.period) : 0.0;
  previous_ = {measured, previous_[0]};
  known_ = std::min(known_ + 1, 2);
  const double wanted =
      gains_.velocity_gain * (gains_.position_gain * (reference - measured) - velocity) + disturbance;
  const double limit = gains_.command_limit;
  if (limit > 0.0 && std::abs(wanted) > limit) {
    return std::copysign(limit, wanted);
  }
  return wanted;
}

void CascadePd::reset(double previous_measured) noexcept {
  previous_ = {previous_measured, previous_measured};
  known_ = 1;
}

void CascadePd::reset(double measured, double velocity) noexcept {
  previous_ = {measured - velocity * gains_.period, measured - 2.0 * velocity * gains_.period};
  known_ = 2;
}

}  // namespace plumbline::controllers
