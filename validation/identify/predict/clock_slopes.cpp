#include "validation/identify/predict/clock_slopes.h"

#include <algorithm>
#include <cmath>

#include "simulator/integrate/command_clock.h"

namespace plumbline::validation {
namespace {

/// d(rate)/d(command of a motor).
Eigen::VectorXd slope_by_command(model::Plant& plant, const Eigen::VectorXd& x, Eigen::VectorXd command,
                                 int motor) {
  constexpr double kShare = 1e-6;
  const double here = command[motor];
  const double step = kShare * std::max(1.0, std::abs(here));
  Eigen::VectorXd up(plant.states());
  Eigen::VectorXd down(plant.states());
  command[motor] = here + step;
  plant.rate(x.data(), command.data(), up.data());
  command[motor] = here - step;
  plant.rate(x.data(), command.data(), down.data());
  return (up - down) / (2.0 * step);
}

/// d(late)/d(parameter) at a time after the record's beginning; clock laws are linear in their parameters.
double lateness_slope(const effects::ClockLaw& law, int parameter, double since) {
  effects::Values unit(static_cast<std::size_t>(law.parameter_count()), 0.0);
  unit[static_cast<std::size_t>(parameter)] = 1.0;
  const effects::ClockError clock = law.clock(unit.data());
  return clock.offset + clock.drift * since;
}

}  // namespace

void clock_slopes(model::Plant& plant, const Eigen::MatrixXd& commands, Eigen::Index k, double period,
                  const Eigen::VectorXd& x, const Eigen::VectorXd& command,
                  const std::vector<model::ParameterId>& parameters, Eigen::MatrixXd& B) {
  int known = -1;
  double since = 0.0;
  Eigen::VectorXd by_late;
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    const model::EffectUse& use = plant.model().effects[static_cast<std::size_t>(parameters[p].effect)];
    const auto* law = dynamic_cast<const effects::ClockLaw*>(use.law.get());
    if (law == nullptr) {
      continue;
    }
    const int motor = plant.model().motor_index(use.at);
    if (motor != known) {
      const effects::ClockError clock = integrate::command_clocks(plant)[static_cast<std::size_t>(motor)];
      const integrate::ClockedCommand at = integrate::clocked_command(commands, motor, k, period, clock);
      by_late = slope_by_command(plant, x, command, motor) * at.slope;
      since = at.since;
      known = motor;
    }
    B.col(static_cast<Eigen::Index>(p)) = by_late * lateness_slope(*law, parameters[p].parameter, since);
  }
}

}  // namespace plumbline::validation
