// MABEL in the plane without ground, by Lagrange's method from the positions of its links alone: none of the
// program's code and none of its files. Numbers: Park, Sreenath, Hurst, Grizzle, "Identification of a Bipedal
// Robot with a Compliant Drivetrain", typed from the paper's tables.
#pragma once

#include <Eigen/Core>

namespace plumbline::oracles {

/// Coordinates: hip forward and up (m), torso against the vertical; then left and right leg angle and leg
/// shape relative to the torso, motors of leg angle and leg shape, pulley B_Spring (rad; zero: legs straight
/// down).
enum MabelCoordinate {
  kHipX,
  kHipZ,
  kTorso,
  kLegAngleLeft,
  kLegShapeLeft,
  kMotorAngleLeft,
  kMotorShapeLeft,
  kSpringLeft,
  kLegAngleRight,
  kLegShapeRight,
  kMotorAngleRight,
  kMotorShapeRight,
  kSpringRight,
  kMabelCoordinates
};
using MabelVector = Eigen::Matrix<double, kMabelCoordinates, 1>;
using MabelMatrix = Eigen::Matrix<double, kMabelCoordinates, kMabelCoordinates>;

/// What the oracle can leave out or put in.
struct MabelOptions {
  bool cables_stretch = true;  ///< else equations 6 and 7 hold rigidly
  bool rotor_spin = false;     ///< rotors and pulleys turn with the torso too (what the program neglects)
};

double mabel_kinetic(const MabelOptions& options, const MabelVector& q, const MabelVector& v);
double mabel_potential(const MabelVector& q);  ///< of gravity

/// M a + bias = force.
MabelMatrix mabel_mass_matrix(const MabelOptions& options, const MabelVector& q);
MabelVector mabel_bias(const MabelOptions& options, const MabelVector& q, const MabelVector& v);

/// All generalised forces but gravity; torques of the motors: leg angle and shape left, then right.
MabelVector mabel_forces(const MabelOptions& options, const MabelVector& q, const MabelVector& v,
                         const Eigen::Vector4d& torques);

/// Accelerations of all thirteen coordinates. With rigid cables q and v must obey equations 6 and 7.
MabelVector mabel_accelerations(const MabelOptions& options, const MabelVector& q, const MabelVector& v,
                                const Eigen::Vector4d& torques);

/// Motors moved to where equations 6 and 7 want them.
MabelVector mabel_without_stretch(MabelVector q);

}  // namespace plumbline::oracles
