// Commands of a record whose clock is not that of the measurements.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "simulator/effects/clock_law.h"
#include "simulator/model/plant.h"

namespace plumbline::integrate {

/// Of each motor the sum of what its clock laws say, with the plant's values.
std::vector<effects::ClockError> command_clocks(const model::Plant& plant);

/// Is any of them wrong?
bool is_any_wrong(const std::vector<effects::ClockError>& clocks);

/// What a command is held at over a sample of the measurements, and how that changes with the time by which
/// it is late.
struct ClockedCommand {
  double held = 0.0;   ///< command units
  double slope = 0.0;  ///< d(held)/d(late), command units/s
  double since = 0.0;  ///< s after the record's beginning, when it jumps in this sample
};

/// The recorded command u(t - offset - drift (t - t_0)) of a motor, t_0 = 0 where the record begins, in
/// sample k, [t_k, t_k + period); samples: motors x N, each held over a period. In that sample it jumps by J
/// after a part r of it. Held is its mean and, so that a jump in the midst of a sample moves a mass as far,
/// not only as fast, a pair of pulses: -r (1 - r)/2 J in its sample and the same back in the next. Before its
/// first sample the record is continued by the first command, behind its last by the last.
ClockedCommand clocked_command(const Eigen::MatrixXd& samples, Eigen::Index motor, Eigen::Index k,
                               double period, const effects::ClockError& clock);

/// All of them, motors x N; `clocks` one for each motor.
Eigen::MatrixXd on_clock_of_measurements(const Eigen::MatrixXd& samples, double period,
                                         const std::vector<effects::ClockError>& clocks);

}  // namespace plumbline::integrate
