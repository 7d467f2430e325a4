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

/// A command's mean over a sample of the measurements, and how that changes with the time by which it is
/// late.
struct ClockedCommand {
  double mean = 0.0;   ///< command units
  double slope = 0.0;  ///< d(mean)/d(late), command units/s
};

/// Mean over sample k, [t_k, t_k + period), of the recorded command u(t - offset - drift (t - t_0)) of a
/// motor, t_0 = 0 where the record begins; samples: motors x N, each held over a period. What is late is
/// taken as it is in the sample's middle, which is wrong by drift period/2 at most. Before its first sample
/// the record is continued by the first command, behind its last by the last.
ClockedCommand clocked_command(const Eigen::MatrixXd& samples, Eigen::Index motor, Eigen::Index k,
                               double period, const effects::ClockError& clock);

/// All of them as commands that are held over the samples of the measurements, with the same impulse in each;
/// `clocks` one for each motor.
Eigen::MatrixXd on_clock_of_measurements(const Eigen::MatrixXd& samples, double period,
                                         const std::vector<effects::ClockError>& clocks);

}  // namespace plumbline::integrate
