// How errors grow in a stance and across a flight, and what feedback makes of them: chapters 6 and 7 of Wu,
// "The Theory, Implementation, and Evaluation of Spring Mass Running on ATRIAS" (Carnegie Mellon University
// 2017).
#pragma once

#include <complex>
#include <vector>

#include "controllers/blocks/riccati.h"

namespace plumbline::spring_mass {

using controllers::LinearSystem;
using controllers::Matrix;
using controllers::Weights;

/// The gait that errors are measured from: hopping in place on the vertical spring of equation 5.2, upright.
struct Gait {
  double mass = 64.0;          ///< kg, section 5.3.1
  double gravity = 9.81;       ///< m/s^2
  double stiffness = 16000.0;  ///< N/m, section 5.3.1
  double landing = 1.09;       ///< m, z0: height of the centre of mass at touchdown, section 4.4.1
  double hop = 0.03;           ///< m, apex above the landing height, section 4.4.1
  double inertia = 2.2;        ///< kg m^2, of the trunk about the centre of mass, section 4.3.1

  double landing_speed() const;      ///< m/s, downward: sqrt(2 g hop)
  double stance_time() const;        ///< s, in closed form
  double flight_time() const;        ///< s
  double height(double time) const;  ///< m, z*(t) in stance: closed form of equation 5.2
  double force(double time) const;   ///< N, F_z*(t)
};

/// Height and its rate, driven by a vertical force error: dz'' = u/m.
LinearSystem<2, 1> vertical_system(const Gait& gait);
/// x, its rate, pitch and its rate, driven by a horizontal force error, about x* = 0 (equation 5.7):
/// x'' = u/m, pitch'' = (x F_z* - z* u)/I.
LinearSystem<4, 1> sagittal_system(const Gait& gait, double time);

/// T_f: from the error at lift-off to the one at the next touchdown. Vertical: the landing height is met, the
/// speed is what is left (section 6.4.2; 6.4.1 prints one sign otherwise, with which none of the eigenvalues
/// come out).
Matrix<2, 2> vertical_flight(const Gait& gait);
/// The same for x and pitch: deadbeat leg placement brings both horizontal errors to 0, pitch turns on.
Matrix<4, 4> sagittal_flight(const Gait& gait);
/// How a change of the landing height moves the vertical error at touchdown (section 6.4.2).
Matrix<2, 1> vertical_placement(const Gait& gait);

/// T_s under feedback gains that are given at `gains.size()` equidistant times of the stance (linear in
/// between); one entry: constant gains.
Matrix<2, 2> vertical_stance(const Gait& gait, const std::vector<Matrix<1, 2>>& gains);
Matrix<4, 4> sagittal_stance(const Gait& gait, const std::vector<Matrix<1, 4>>& gains);

/// Constant gains for a stance that never ends: closed form of the two-state problem, with q1, q2 the weights
/// of height and rate and r of the force: kp = sqrt(q1/r), kd = sqrt(q2/r + 2 m kp).
Matrix<1, 2> vertical_lqr(const Gait& gait, double q1, double q2, double r);

template <int N>
struct Regulator {
  std::vector<Matrix<1, N>> gains;  ///< at steps + 1 times of the stance
  Matrix<N, N> cost;                ///< at touchdown
  int strides = 1;                  ///< until converged; 1: finite horizon
};
/// Finite horizon: one stance that ends with the cost `penalty`.
Regulator<2> vertical_finite(const Gait& gait, const Weights<2, 1>& weights, const Matrix<2, 2>& penalty);
Regulator<4> sagittal_finite(const Gait& gait, const Weights<4, 1>& weights, const Matrix<4, 4>& penalty);
/// Infinite horizon by the jump Riccati equation; `last` is the cost that the backward integration begins
/// with.
Regulator<2> vertical_infinite(const Gait& gait, const Weights<2, 1>& weights, const Matrix<2, 2>& flight,
                               const Matrix<2, 2>& penalty, const Matrix<2, 2>& last);
Regulator<4> sagittal_infinite(const Gait& gait, const Weights<4, 1>& weights, const Matrix<4, 4>& penalty);

/// Of a real matrix; the largest magnitude first.
template <int N>
std::vector<std::complex<double>> eigenvalues(const Matrix<N, N>& matrix);
/// Largest singular value of W^(1/2) a W^(-1/2) (section 7.5.1).
double weighted_norm(const Matrix<2, 2>& a, const Matrix<2, 2>& weight);
/// The solution W of a' W a - W = -q (equation 7.7).
Matrix<2, 2> lyapunov(const Matrix<2, 2>& a, const Matrix<2, 2>& q);

/// The trunk's inertia that a T_s asks for, from its last column (what an error of the pitch rate becomes).
/// About the foot, dL/dt = m g x whatever the feedback, with L = I pitch' + m (z* x' - z*' x). The integral
/// of x over the stance is taken from the cubic through its ends: 3 % off for the inertia (tests). In the
/// other columns the inertia is a small difference of large numbers, and the cubic does not do.
double inertia_of(const Gait& gait, const Matrix<4, 4>& stance);

/// Largest vertical error at the end of a stance that a force error of at most `force` N can bring
/// (equation 7.2 with a rank-one weight): the integral of |Phi_12(T, t)|/m times `force`.
double largest_drift(const Gait& gait, const std::vector<Matrix<1, 2>>& gains, double force);

}  // namespace plumbline::spring_mass
