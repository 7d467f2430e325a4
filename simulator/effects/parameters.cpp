#include "simulator/effects/parameters.h"

#include <cmath>

namespace plumbline::effects {
namespace {

constexpr const char* kSmoothingName = "smoothing_speed";
constexpr const char* kRestName = "rest";         // is_rest() is asked at every sample of a linearisation
constexpr double kStandardSmoothingSpeed = 0.01;  // where no trial gives a better one
constexpr double kTiny = 1e-12;                   // magnitudes below are taken as "not known"

double positive_or_one(double value) { return std::isfinite(value) && value > kTiny ? value : 1.0; }

}  // namespace

Parameter any(const std::string& name, const std::string& unit, const std::string& meaning) {
  return {name, unit, meaning, 0.0, -kInfinity, kInfinity, Scale::linear, false};
}

Parameter non_negative(const std::string& name, const std::string& unit, const std::string& meaning) {
  return {name, unit, meaning, 0.0, 0.0, kInfinity, Scale::linear, false};
}

Parameter positive(const std::string& name, const std::string& unit, const std::string& meaning,
                   double standard) {
  return {name, unit, meaning, standard, kSmallestPositive, kInfinity, Scale::logarithm, false};
}

Parameter fixed(const std::string& name, const std::string& unit, const std::string& meaning, double standard,
                double lower, double upper) {
  return {name, unit, meaning, standard, lower, upper, Scale::linear, true};
}

Parameter smoothing_speed() {
  return fixed(kSmoothingName, "{position}/s", "speed below which the sign of the velocity is smoothed",
               kStandardSmoothingSpeed, kSmallestPositive, kInfinity);
}

bool is_smoothing_speed(const Parameter& parameter) { return parameter.name == kSmoothingName; }

Parameter rest() { return any(kRestName, "{position}", "position from which the law measures"); }

bool is_rest(const Parameter& parameter) { return parameter.name == kRestName; }

Parameter fixed_side() {
  return fixed("side", "1", "+1: acts above the position, -1: acts below it", 1.0, -1.0, 1.0);
}

Scales guarded(const Scales& scales) {
  Scales result;
  result.position = positive_or_one(scales.position);
  result.velocity = positive_or_one(scales.velocity);
  result.force = positive_or_one(scales.force);
  result.inertia = positive_or_one(scales.inertia);
  result.period = positive_or_one(scales.period);
  result.center = std::isfinite(scales.center) ? scales.center : 0.0;
  return result;
}

Scales seen_from(const Scales& scales, double travel) {
  Scales seen = scales;
  const double size = std::abs(travel);
  seen.position *= size;
  seen.velocity *= size;
  seen.center *= travel;
  seen.force /= size;
  seen.inertia /= size * size;
  return seen;
}

double smoothing_speed_for(const Scales& scales) { return 0.002 * guarded(scales).velocity; }

std::vector<Values> starts_at_rests(Values p, std::size_t rest, const Scales& scales,
                                    const std::vector<double>& shares) {
  const Scales s = guarded(scales);
  std::vector<Values> starts;
  for (const double share : shares) {
    p[rest] = s.center + share * s.position;
    starts.push_back(p);
  }
  return starts;
}

double smooth_sign(double v, double speed) {
  if (speed > 0.0) return std::tanh(v / speed);
  return v == 0.0 ? 0.0 : std::copysign(1.0, v);
}

}  // namespace plumbline::effects
