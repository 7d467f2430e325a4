#include "simulator/integrate/command_clock.h"

#include <algorithm>
#include <cmath>

namespace plumbline::integrate {

std::vector<effects::ClockError> command_clocks(const model::Plant& plant) {
  const model::Model& model = plant.model();
  std::vector<effects::ClockError> clocks(model.motors.size());
  for (std::size_t e = 0; e < model.effects.size(); ++e) {
    const auto* law = dynamic_cast<const effects::ClockLaw*>(model.effects[e].law.get());
    const int motor = law == nullptr ? -1 : model.motor_index(model.effects[e].at);
    if (motor < 0) {
      continue;
    }
    effects::Values values;
    for (int p = 0; p < law->parameter_count(); ++p) {
      values.push_back(plant.value({static_cast<int>(e), p}));
    }
    const effects::ClockError one = law->clock(values.data());
    clocks[static_cast<std::size_t>(motor)].offset += one.offset;
    clocks[static_cast<std::size_t>(motor)].drift += one.drift;
  }
  return clocks;
}

bool is_any_wrong(const std::vector<effects::ClockError>& clocks) {
  return std::any_of(clocks.begin(), clocks.end(),
                     [](const effects::ClockError& one) { return one.offset != 0.0 || one.drift != 0.0; });
}

// Late by w whole samples and a part r of one: for the part r of the sample the command before still holds.
ClockedCommand clocked_command(const Eigen::MatrixXd& samples, Eigen::Index motor, Eigen::Index k,
                               double period, const effects::ClockError& clock) {
  const double middle = (static_cast<double>(k) + 0.5) * period;
  const double late = (clock.offset + clock.drift * middle) / period;
  const double whole = std::clamp(std::floor(late), -1e9, 1e9);  // no record is as long
  const auto given = [&](double behind) {
    const double at =
        std::clamp(static_cast<double>(k) - whole - behind, 0.0, static_cast<double>(samples.cols() - 1));
    return samples(motor, static_cast<Eigen::Index>(at));
  };
  const double part = late - whole;
  return {(1.0 - part) * given(0.0) + part * given(1.0), (given(1.0) - given(0.0)) / period};
}

Eigen::MatrixXd on_clock_of_measurements(const Eigen::MatrixXd& samples, double period,
                                         const std::vector<effects::ClockError>& clocks) {
  Eigen::MatrixXd moved = samples;
  for (Eigen::Index m = 0; m < samples.rows(); ++m) {
    const effects::ClockError& clock = clocks[static_cast<std::size_t>(m)];
    if (clock.offset == 0.0 && clock.drift == 0.0) {
      continue;
    }
    for (Eigen::Index k = 0; k < samples.cols(); ++k) {
      moved(m, k) = clocked_command(samples, m, k, period, clock).mean;
    }
  }
  return moved;
}

}  // namespace plumbline::integrate
