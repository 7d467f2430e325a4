// What every law of the ground is: a normal or a tangential force on a point foot.
// Pure: Eigen and the standard library only. A law knows nothing of robots, terrain or integrators.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "simulator/effects/law.h"

namespace plumbline::contact {

/// How the ground differs from what a foot's laws say: factors on their elastic, damping and friction
/// coefficients, and what its surface is higher by, m.
struct GroundChange {
  double stiffness = 1.0;
  double damping = 1.0;
  double friction = 1.0;
  double height = 0.0;
};

/// Normal force of the ground on a point foot.
/// depth > 0 inside the ground, m; rate = d(depth)/dt, m/s.
/// Power balance, which the tests check: force * rate = d(stored_energy)/dt + dissipated_power.
class NormalLaw : public effects::Law {
 public:
  /// Out of the ground, N; never negative (the ground does not pull), and 0 where depth <= 0.
  virtual double force(double depth, double rate, const double* p) const = 0;
  /// J; 0 where depth <= 0.
  virtual double stored_energy(double depth, const double* p) const = 0;
  /// W
  virtual double dissipated_power(double depth, double rate, const double* p) const = 0;
  /// Switching functions: the force is smooth between their zeros. Appended to `g`; always the same number.
  virtual void switches(double depth, double rate, const double* p, std::vector<double>& g) const;
  /// Makes the law's values those of a changed ground (its height apart). Default: it does not feel it.
  virtual void apply(const GroundChange& change, double* p) const;
};

/// Force of the ground on a point foot along the ground's plane.
/// slip: velocity of the foot along the plane, its own direction of travel first, then to its left, m/s;
/// normal: the normal law's force, N, not negative. Power balance at constant normal force, which the tests
/// check:
///   force . slip = - d(stored_energy)/dt - dissipated_power.
class TangentialLaw : public effects::Law {
 public:
  /// ON the foot, N, in the axes of `slip`.
  virtual Eigen::Vector2d force(const Eigen::Vector2d& slip, double normal, const double* state,
                                const double* p) const = 0;
  /// d(state)/dt, state_count() values written to `rate`.
  virtual void state_rate(const Eigen::Vector2d& slip, double normal, const double* state, const double* p,
                          double* rate) const;
  /// J
  virtual double stored_energy(double normal, const double* state, const double* p) const;
  /// Is the force the same in all directions of the plane? Default: yes.
  virtual bool is_isotropic(const double* p) const;
  /// W, at constant normal force.
  virtual double dissipated_power(const Eigen::Vector2d& slip, double normal, const double* state,
                                  const double* p) const = 0;
  /// Makes the law's values those of a changed ground. Default: it does not feel it.
  virtual void apply(const GroundChange& change, double* p) const;
};

}  // namespace plumbline::contact
