#include "validation/api/effects_picture.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "simulator/effects/clock_law.h"
#include "simulator/effects/inertial_sensor_law.h"
#include "simulator/effects/late_sensor_law.h"
#include "simulator/effects/parameters.h"

namespace plumbline::api {
namespace {

using effects::ActuatorLaw;
using effects::ForceLaw;
using effects::Motion;
using effects::Values;

using Curve = std::vector<std::pair<double, double>>;

constexpr int kSteps = 4000;  // of a period: bristles are stiff
constexpr int kDrawn = 160;
constexpr double kPeriod = 2.0 * effects::kPi;

/// One of the law's starts (of play, the widest), with what is nothing there at its typical size, and each
/// further parameter smaller than the one before: two stiffnesses are to be seen as two.
Values drawn_values(const effects::Law& law) {
  constexpr double kLess = 0.6;
  const effects::Scales scales{1.0, 0.7, 1.0, 1.0, 0.3, 0.0};
  const std::vector<Values> starts = law.starts(scales);
  const Values typical = law.typical(scales);
  const bool is_ratio = law.sits_at(effects::Place::ratio);
  Values values = is_ratio ? starts.back() : starts.front();
  if (is_ratio && law.state_count() > 0) {
    values = typical;  // a coupling: where a search starts it is too stiff for these steps
  }
  double share = 1.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const effects::Parameter& parameter = law.declaration().parameters[i];
    const bool is_rest = effects::is_rest(parameter);
    if (!parameter.structural && !is_rest && values[i] == parameter.null_value) {
      values[i] = std::min(parameter.null_value + share * typical[i], parameter.upper);
      share *= kLess;
    }
    values[i] = is_rest ? 0.0 : effects::is_smoothing_speed(parameter) ? 0.03 : values[i];
  }
  return values;
}

/// The states along `rate(t, states, rates)` over two periods; `note(t, states)` at the drawn instants of the
/// second.
void follow(int count, const std::function<void(double, const double*, double*)>& rate,
            const std::function<void(double, const double*)>& note) {
  std::vector<double> s(static_cast<std::size_t>(count) + 1, 0.0);
  std::vector<double> middle = s;
  std::vector<double> slope = s;
  const double h = kPeriod / kSteps;
  for (int i = 0; i <= 2 * kSteps; ++i) {
    const double t = i * h;
    if (i >= kSteps && (i - kSteps) % (kSteps / kDrawn) == 0) {
      note(t, s.data());
    }
    rate(t, s.data(), slope.data());
    for (std::size_t k = 0; k < s.size(); ++k) {
      middle[k] = s[k] + 0.5 * h * slope[k];
    }
    rate(t + 0.5 * h, middle.data(), slope.data());
    for (std::size_t k = 0; k < s.size(); ++k) {
      s[k] += h * slope[k];
    }
  }
}

/// Least and largest value, at least about the same on both sides of 0.
double reach(const Curve& curve, bool of_second) {
  double most = 0.0;
  for (const auto& [x, y] : curve) {
    most = std::max(most, std::abs(of_second ? y : x));
  }
  return most > 0.0 ? most : 1.0;
}

std::string panel(const Curve& curve, double left, const std::string& across, const std::string& up) {
  constexpr double kWide = 104.0;
  constexpr double kHigh = 80.0;
  constexpr double kTop = 8.0;
  const double x0 = left + 0.5 * kWide;
  const double y0 = kTop + 0.5 * kHigh;
  const double wide = 0.46 * kWide / reach(curve, false);
  const double high = 0.46 * kHigh / reach(curve, true);
  std::string points;
  for (const auto& [x, y] : curve) {
    // Rounded to a tenth of a pixel, and no "-0.0": the same text on every machine.
    points += fmt::format("{}{:.1f},{:.1f}", points.empty() ? "" : " ", x0 + wide * x, y0 - high * y);
  }
  return fmt::format(
      "<path d=\"M{:.1f},{:.1f}h{:.1f}M{:.1f},{:.1f}v{:.1f}\" stroke=\"#9aa4ad\" fill=\"none\"/>\n"
      "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"end\">{}</text><text x=\"{:.1f}\" "
      "y=\"{:.1f}\">{}</text>\n"
      "<polyline points=\"{}\" stroke=\"#1f6fb4\" stroke-width=\"1.5\" fill=\"none\"/>\n",
      left, y0, kWide, x0, kTop, kHigh, left + kWide, y0 - 3.0, across, x0 + 3.0, kTop + 7.0, up, points);
}

std::string svg(const std::string& panels) {
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"240\" height=\"96\" viewBox=\"0 0 240 96\" "
         "font-family=\"sans-serif\" font-size=\"8\" fill=\"#5b6770\">\n"
         "<rect width=\"240\" height=\"96\" fill=\"#ffffff\"/>\n" +
         panels + "</svg>\n";
}

std::string of_force(const ForceLaw& law) {
  const Values p = drawn_values(law);
  const auto motion = [](double t) { return Motion{std::sin(t), std::cos(t), 2.5 * std::sin(t + 0.8)}; };
  Curve over_position;
  Curve over_velocity;
  follow(
      law.state_count(),
      [&](double t, const double* s, double* rate) { law.state_rate(motion(t), s, p.data(), rate); },
      [&](double t, const double* s) {
        const Motion m = motion(t);
        const double force = law.force(m, s, p.data());
        over_position.emplace_back(m.position, force);
        over_velocity.emplace_back(m.velocity, force);
      });
  const bool stretch = law.sits_at(effects::Place::ratio);
  return svg(panel(over_position, 8.0, stretch ? "stretch" : "position", "force") +
             panel(over_velocity, 128.0, stretch ? "its rate" : "velocity", "force"));
}

std::string of_actuator(const ActuatorLaw& law) {
  const Values p = drawn_values(law);
  Curve over_command;
  Curve over_time;
  follow(
      law.state_count(),
      [&](double t, const double* s, double* rate) { law.state_rate(2.0 * std::sin(t), s, p.data(), rate); },
      [&](double t, const double* s) {
        const double torque = law.torque(2.0 * std::sin(t), s, p.data());
        over_command.emplace_back(2.0 * std::sin(t), torque);
        over_time.emplace_back(t - 1.5 * kPeriod, torque);
      });
  return svg(panel(over_command, 8.0, "command", "torque") + panel(over_time, 128.0, "time", "torque"));
}

std::string of_sensor(const effects::SensorLaw& law) {
  const Values p = drawn_values(law);
  Curve readings;
  Curve errors;
  for (int i = -kDrawn / 2; i <= kDrawn / 2; ++i) {
    const double actual = 2.0 * effects::kPi * i / kDrawn;
    const double reading = law.reading(actual, p.data());
    readings.emplace_back(actual, reading);
    errors.emplace_back(actual, reading - actual);
  }
  return svg(panel(readings, 8.0, "true value", "reading") + panel(errors, 128.0, "true value", "error"));
}

/// What it reads of a vector that turns once in the plane of its first two axes.
std::string of_inertial_sensor(const effects::InertialSensorLaw& law) {
  const effects::InertialReading reads = law.inertial_reading(drawn_values(law).data());
  Curve readings;
  Curve errors;
  for (int i = 0; i <= kDrawn; ++i) {
    const double angle = kPeriod * i / kDrawn;
    const Eigen::Vector3d actual(std::cos(angle), std::sin(angle), 0.0);
    const Eigen::Vector3d reading = reads.gain * actual + reads.bias;
    readings.emplace_back(reading.x(), reading.y());
    errors.emplace_back(angle - 0.5 * kPeriod, reading.x() - actual.x());
  }
  return svg(panel(readings, 8.0, "x", "y") + panel(errors, 128.0, "turn", "error of x"));
}

}  // namespace

std::string effect_picture(const effects::Law& law) {
  if (const auto* force = dynamic_cast<const ForceLaw*>(&law)) {
    return of_force(*force);
  }
  if (dynamic_cast<const effects::ClockLaw*>(&law) != nullptr) {
    return "";
  }
  const auto* actuator = dynamic_cast<const ActuatorLaw*>(&law);
  if (actuator != nullptr && !law.sits_at(effects::Place::world) &&
      actuator->delay(drawn_values(law).data()) == 0.0) {
    return of_actuator(*actuator);
  }
  if (const auto* inertial = dynamic_cast<const effects::InertialSensorLaw*>(&law)) {
    return of_inertial_sensor(*inertial);
  }
  const auto* sensor = dynamic_cast<const effects::SensorLaw*>(&law);
  const bool is_late = dynamic_cast<const effects::LateSensorLaw*>(&law) != nullptr;
  const bool is_of_time = is_late || law.state_count() > 0;
  return sensor != nullptr && !is_of_time ? of_sensor(*sensor) : "";
}

}  // namespace plumbline::api
