// Words for declaring the parameters of a law, and guards around the magnitudes of a trial.
#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "simulator/effects/law.h"

namespace plumbline::effects {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kPi = 3.14159265358979323846;
constexpr double kSmallestPositive = 1e-9;  ///< lower bound of quantities that must not be zero

/// Any sign; null value 0.
Parameter any(const std::string& name, const std::string& unit, const std::string& meaning);
/// At least 0; null value 0.
Parameter non_negative(const std::string& name, const std::string& unit, const std::string& meaning);
/// A positive quantity without a null value of its own, searched by its logarithm.
Parameter positive(const std::string& name, const std::string& unit, const std::string& meaning,
                   double standard);
/// A choice or numerical constant that is never fitted.
Parameter fixed(const std::string& name, const std::string& unit, const std::string& meaning, double standard,
                double lower, double upper);
/// The speed below which the sign of a velocity is smoothed, {position}/s.
Parameter smoothing_speed();
bool is_smoothing_speed(const Parameter& parameter);
/// A position from which a law measures: its force depends on x - rest alone, not on either by itself. Of no
/// effect while the law has no strength; standard value 0.
Parameter rest();
/// Is this the parameter that rest() declares?
bool is_rest(const Parameter& parameter);
/// +1 or -1: where the law acts, above or below a position.
Parameter fixed_side();

/// The same magnitudes with zeros, infinities and NaN replaced by 1 (center: by 0), so that quotients are
/// finite and not zero.
Scales guarded(const Scales& scales);
/// The same motion and force as seen from a place that moves by `travel` when the first moves by one.
Scales seen_from(const Scales& scales, double travel);

/// Sensible smoothing speed: 0.2 % of the root-mean-square velocity, {position}/s.
double smoothing_speed_for(const Scales& scales);

/// One start for each share: `p` with its rest that share of the motion's half range from the motion's
/// center.
std::vector<Values> starts_at_rests(Values p, std::size_t rest, const Scales& scales,
                                    const std::vector<double>& shares);

/// tanh(v / speed), a smooth sign(v); the sign itself when speed is not positive. (Andersson, Soderberg and
/// Bjorklund, Tribology International 40, 2007, compare this form with others.)
double smooth_sign(double v, double speed);

}  // namespace plumbline::effects
