#include "simulator/integrate/command_clock.h"

#include <algorithm>
#include <cmath>

namespace plumbline::integrate {
namespace {

/// Of a command within a sample: what it is before, by how much it jumps, after which part of the sample.
struct Jump {
  double before = 0.0, size = 0.0, part = 0.0;
};

// Command j takes effect at the instant t at which t - offset - drift (t - t_0) = j period. Late by w whole
// samples and a part of one, for the part r of sample k the command k - w - 1 still holds.
Jump jump_in(const Eigen::MatrixXd& samples, Eigen::Index motor, Eigen::Index k, double period,
             const effects::ClockError& clock) {
  const double late = clock.offset / period + clock.drift * static_cast<double>(k);
  const double whole = std::clamp(std::floor(late), -1e9, 1e9);  // no record is as long
  const auto given = [&](double behind) {
    const double at =
        std::clamp(static_cast<double>(k) - whole - behind, 0.0, static_cast<double>(samples.cols() - 1));
    return samples(motor, static_cast<Eigen::Index>(at));
  };
  return {given(1.0), given(0.0) - given(1.0), std::min(1.0, (late - whole) / (1.0 - clock.drift))};
}

}  // namespace

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

ClockedCommand clocked_command(const Eigen::MatrixXd& samples, Eigen::Index motor, Eigen::Index k,
                               double period, const effects::ClockError& clock) {
  const Jump here = jump_in(samples, motor, k, period, clock);
  const Jump last = jump_in(samples, motor, k - 1, period, clock);
  const double pulse = 0.5 * here.part * (1.0 - here.part) * here.size;
  const double back = 0.5 * last.part * (1.0 - last.part) * last.size;
  const double change =
      -here.size - (0.5 - here.part) * here.size + (0.5 - last.part) * last.size;  // with the part
  return {here.before + (1.0 - here.part) * here.size - pulse + back, change / (period * (1.0 - clock.drift)),
          (static_cast<double>(k) + here.part) * period};
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
      moved(m, k) = clocked_command(samples, m, k, period, clock).held;
    }
  }
  return moved;
}

}  // namespace plumbline::integrate
