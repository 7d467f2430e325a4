// A motion under known torques, to be simulated by any method, and how far two simulations of it are apart.
#pragma once

#include <Eigen/Core>

#include "simulator/integrate/integrator.h"
#include "simulator/model/model.h"
#include "simulator/model/plant.h"

namespace plumbline::benchmarks {

struct Replay {
  model::Model model;
  Eigen::VectorXd start;
  Eigen::MatrixXd commands;  ///< motors x samples, held over each sample
  double period = 0.0;       ///< s

  double seconds() const { return period * static_cast<double>(commands.cols()); }
};

/// The state at the end of every sample.
struct Course {
  Eigen::MatrixXd states;  ///< states x samples
  integrate::Summary summary;
  double seconds = 0.0;  ///< of processor time
};

Course simulate(const Replay& replay, model::Plant& plant, const integrate::Options& options);

/// Of the positions (about their mean over the hop) and of the velocities, the larger: the root of the sum
/// over all samples of d' M d, relative to the same of the reference; d: difference, M: the reference's mass
/// matrix. For velocities that is the root of the error's kinetic energy; no choice of coordinates or units
/// enters.
double trajectory_error(const Course& course, const Course& reference, model::Plant& plant);

/// Largest over the independent positions and velocities of the root mean square of the difference over the
/// hop, relative to that of the reference about its mean. One that hardly moves (a pulley in its stop) counts
/// as much as the torso.
double worst_coordinate(const Course& course, const Course& reference, const model::Plant& plant);

}  // namespace plumbline::benchmarks
